#include "engine/session/engine_session.h"

#include "engine/session/edit_mailbox.h"
#include "engine/session/quality_scheduler.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace atrium {
namespace {

using Clock = RunContext::Clock;

// Progress may be reported far more often than anybody can look at it.
constexpr std::chrono::milliseconds kWakeInterval{33};
// A first picture that came sooner gets no number: the complete one follows at once.
constexpr std::chrono::milliseconds kWorthALook{1500};

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// Time left at the pace so far; negative while there is too little to go by.
double estimate_remaining(double elapsed, double fraction) {
    return fraction < 0.02 || elapsed < 0.1 ? -1.0 : elapsed * (1.0 - fraction) / fraction;
}

} // namespace

struct EngineSession::Impl {
    using Picture = std::shared_ptr<const Solution>;

    Impl(std::function<void()> wake_function, SolveFunction solve_function, AuditFunction audit_function)
        : wake(std::move(wake_function)), solve(std::move(solve_function)), audit(std::move(audit_function)),
          thread([this] { run(); }) {}
    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            quit = true;
            running_stop.request_stop();
        }
        changed.notify_all();
        thread.join();
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    struct Load {
        Scene scene;
        std::uint64_t revision = 0;
    };
    /// What solutions are to tell beside the light.
    struct Wishes {
        bool landings = false;
        bool insides = false;
    };
    struct Ended {
        QualityScheduler::Outcome outcome = QualityScheduler::Outcome::Failed;
        Picture picture; ///< may be null
        std::string message;
        std::shared_ptr<const LocalError> error; ///< of the picture, where it was measured
    };

    // ---- engine thread ----

    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            const auto busy = [&] {
                return quit || pending_load || !mailbox.empty() || scheduler.should_start(Clock::now());
            };
            while (!busy()) { // until the hand has rested, where that is what is waited for
                if (const auto start = scheduler.start_time(); start == QualityScheduler::Time::max()) {
                    changed.wait(lock);
                } else {
                    changed.wait_until(lock, start);
                }
            }
            if (quit) {
                return;
            }
            std::optional<Load> loaded = std::exchange(pending_load, std::nullopt);
            const EditMailbox::Batch batch = mailbox.take();
            lock.unlock();
            const std::string refusal = bring_up_to_date(std::move(loaded), batch);
            lock.lock();
            if (!refusal.empty() && !pending_load) {
                scheduler.on_failure();
                message = refusal;
            }
            if (scheduler.should_start(Clock::now()) && !pending_load && mailbox.empty() && !quit) {
                solve_once(lock);
            }
            lock.unlock();
            tell();
            lock.lock();
        }
    }

    /// Applies what came in to the engine's own scene; returns why an edit was refused, or nothing.
    std::string bring_up_to_date(std::optional<Load> loaded, const EditMailbox::Batch& batch) {
        if (loaded) {
            scene = std::move(loaded->scene);
            revision = loaded->revision;
        }
        std::string refusal;
        for (const SceneEdit& edit : batch.edits) {
            if (const auto done = apply(scene, edit); !done && refusal.empty()) {
                refusal = "An edit could not be carried over to the light simulation: " + done.error().message();
            }
        }
        if (!batch.edits.empty()) {
            revision = batch.revision;
        }
        return refusal;
    }

    /// Called and left with the lock held; the solve itself runs without.
    void solve_once(std::unique_lock<std::mutex>& lock) {
        const QualityScheduler::Kind kind = scheduler.kind();
        // Where good light is on show a first, coarse picture would be a step back.
        const bool good_on_show =
            scheduler.unsettled() || scheduler.refining() || (latest && latest->final && latest_revision == revision);
        scheduler.on_started(kind);
        running_stop = StopFlag();
        started = Clock::now();
        phase.clear();
        fraction = 0.0;
        message.clear();
        const StopFlag stop = running_stop;
        const Wishes wishes = wanted;
        const Picture complete = latest;
        lock.unlock();
        tell();
        Ended ended = kind == QualityScheduler::Kind::Audit ? audit_guarded(stop, complete, scene.settings.quality)
                                                            : solve_guarded(stop, kind, good_on_show, wishes);
        const bool updatable = ended.picture && ended.picture->updatable;
        lock.lock();
        if (ended.picture && !scheduler.abandoned() && ended.picture != latest) {
            if (latest && !latest->surfaces.empty() && latest->surfaces == ended.picture->surfaces && !ended.error) {
                keep_audit(ended); // the same light, told with more or less beside it
            }
            publish(std::move(ended.picture), std::move(ended.error));
        }
        if (ended.outcome == QualityScheduler::Outcome::Failed && !scheduler.abandoned()) {
            message = std::move(ended.message);
        }
        scheduler.on_finished(ended.outcome, updatable, audit && latest && latest->statistics.audit.points == 0);
        ask_for_wishes();
        phase.clear();
        last_duration = Clock::now() - started;
    }

    SolveOptions options_of_scene() const {
        SolveOptions options;
        options.quality = scene.settings.quality;
        options.seed = scene.settings.seed;
        options.revision = revision;
        return options;
    }

    /// The number beside the light. That it could not be had is no failure: the light stands.
    Ended audit_guarded(const StopFlag& stop, const Picture& light, SolverSettings::Quality quality) {
        RunContext context;
        context.stop = stop;
        SolveOptions options = options_of_scene();
        options.quality = quality;
        try {
            Audited out = audit(scene, light, options, context);
            return {stop.stop_requested() ? QualityScheduler::Outcome::Stopped : QualityScheduler::Outcome::Audited,
                    std::move(out.solution),
                    {},
                    out.places.empty() ? nullptr : std::make_shared<const LocalError>(std::move(out.places))};
        } catch (...) {
            return {QualityScheduler::Outcome::Stopped, nullptr, {}, nullptr};
        }
    }

    Ended solve_guarded(const StopFlag& stop, QualityScheduler::Kind kind, bool good_on_show, Wishes wishes) {
        using Outcome = QualityScheduler::Outcome;
        RunContext context;
        context.stop = stop;
        context.on_progress = [&](const Progress& p) { on_progress(p); };
        SolveOptions options = options_of_scene();
        options.keep_for_updates = true;
        options.hurried = kind == QualityScheduler::Kind::Hurried;
        options.settle = kind == QualityScheduler::Kind::Settle;
        options.skip_first_picture = good_on_show;
        options.keep_landings = wishes.landings;
        options.keep_insides = wishes.insides;
        try {
            auto result = solve(scene, options, context, [&](const Picture& picture) {
                on_snapshot(picture);
                look_at_first(picture, stop);
            });
            if (!result) {
                const Outcome failed = kind == QualityScheduler::Kind::Full ? Outcome::Failed : Outcome::Unfit;
                return {stop.stop_requested() ? Outcome::Stopped : failed, nullptr, result.error().message(), nullptr};
            }
            if (*result == nullptr) {
                return {Outcome::Failed, nullptr, "The light simulation returned no picture.", nullptr};
            }
            if (kind != QualityScheduler::Kind::Full && !(*result)->final) {
                return {options.hurried ? Outcome::Hurried : Outcome::Settled, *result, {}, nullptr};
            }
            return {(*result)->final ? Outcome::Final : Outcome::Stopped, *result, {}, nullptr};
        } catch (const std::bad_alloc&) {
            return {Outcome::Failed, nullptr, "There is not enough memory for the light of this scene.", nullptr};
        } catch (const std::exception& e) {
            return {Outcome::Failed, nullptr, std::string("The light simulation failed: ") + e.what(), nullptr};
        } catch (...) {
            return {Outcome::Failed, nullptr, "The light simulation failed for an unknown reason.", nullptr};
        }
    }

    void on_progress(const Progress& progress) {
        const auto now = Clock::now();
        bool news = false;
        {
            const std::lock_guard lock(mutex);
            news = phase != progress.phase || now - last_wake >= kWakeInterval;
            phase = progress.phase;
            fraction = std::clamp(progress.fraction, fraction, 1.0);
        }
        if (news) {
            last_wake = now;
            tell();
        }
    }

    /// A first, coarse picture gets its number too, where it took so long that the look hardly adds to it.
    void look_at_first(const Picture& picture, const StopFlag& stop) {
        if (!audit || picture == nullptr || picture->final || Clock::now() - started < kWorthALook) {
            return;
        }
        const Ended known = audit_guarded(stop, picture, SolverSettings::Quality::Draft); // few places, few paths
        if (known.picture != nullptr && known.picture != picture) {
            on_snapshot(known.picture);
        }
    }

    void on_snapshot(const Picture& picture) {
        {
            const std::lock_guard lock(mutex);
            if (picture == nullptr || scheduler.abandoned()) {
                return;
            }
            publish(picture);
        }
        tell();
    }

    void tell() const {
        if (wake) {
            wake();
        }
    }

    // ---- with the lock held ----

    void publish(Picture picture, std::shared_ptr<const LocalError> measured = nullptr) {
        latest_revision = revision; // of the scene being solved; publish() is called during a solve only
        latest = std::move(picture);
        error = std::move(measured);
        drop_insides();
    }
    /// What is known of the error of the picture on show is known of another picture of the same light.
    void keep_audit(Ended& ended) const {
        if (ended.picture->statistics.audit.points == 0 && latest->statistics.audit.points > 0) {
            auto known = std::make_shared<Solution>(*ended.picture);
            known->statistics.audit = latest->statistics.audit;
            known->statistics.error_estimate = latest->statistics.error_estimate;
            ended.picture = std::move(known);
            ended.error = error;
        }
    }
    /// Insides that nobody wants any more go, with their memory.
    void drop_insides() {
        if (!wanted.insides && latest && latest->insides) {
            auto bare = std::make_shared<Solution>(*latest);
            bare->insides.reset();
            latest = std::move(bare);
        }
    }
    /// A complete picture that does not tell what is wanted is made anew.
    void ask_for_wishes() {
        if (scheduler.state() != QualityScheduler::State::Idle || !latest || !latest->final) {
            return;
        }
        const bool landings = wanted.landings && !latest->landings && latest->statistics.particles_stored > 0;
        const bool insides = wanted.insides && !latest->insides && latest->updatable;
        if (landings || insides) {
            scheduler.on_edit(Clock::now(), true, false);
        }
    }
    /// Tells the running solve when it is of no more use: now, or once the hand has rested. No timer is needed for that.
    void stop_if_stale() const { running_stop.request_stop_at(scheduler.stop_time()); }

    // ---- any thread ----

    void load(Scene document, std::uint64_t document_revision, Picture stored) {
        Load next{document, document_revision};
        const std::lock_guard posting_lock(posting);
        posted = std::move(document);
        {
            const std::lock_guard lock(mutex);
            mailbox.clear();
            pending_load = std::move(next);
            scheduler.on_load(stored != nullptr, stored != nullptr && stored->final);
            latest = std::move(stored);
            error.reset();
            latest_revision = document_revision; // a stored solution is of the scene it was stored with
            posted_revision = document_revision;
            light_revision = document_revision;
            phase.clear();
            fraction = 0.0;
            message.clear();
            last_duration = {};
            stop_if_stale();
        }
        changed.notify_all();
    }

    void post(const SceneEdit& edit, std::uint64_t edit_revision, bool in_gesture) {
        const std::lock_guard posting_lock(posting);
        const bool neutral = leaves_light_unchanged(posted, edit);
        (void)apply(posted, edit); // a refusal is found again, and reported, on the engine thread
        const auto now = Clock::now();
        {
            const std::lock_guard lock(mutex);
            mailbox.post(edit, edit_revision);
            posted_revision = edit_revision;
            if (!neutral) {
                light_revision = edit_revision;
            }
            scheduler.on_edit(now, !neutral, in_gesture);
            stop_if_stale();
        }
        changed.notify_all();
    }

    template <class F> void steer(F&& event) {
        {
            const std::lock_guard lock(mutex);
            event();
            stop_if_stale();
        }
        changed.notify_all();
    }

    [[nodiscard]] SessionStatus status() const {
        const auto now = Clock::now();
        const std::lock_guard lock(mutex);
        SessionStatus out;
        switch (scheduler.state()) {
        case QualityScheduler::State::Idle: out.state = SessionStatus::State::Idle; break;
        case QualityScheduler::State::Solving: out.state = SessionStatus::State::Solving; break;
        case QualityScheduler::State::Stopped: out.state = SessionStatus::State::Stopped; break;
        case QualityScheduler::State::Failed: out.state = SessionStatus::State::Failed; break;
        }
        const bool solving = out.state == SessionStatus::State::Solving;
        out.moving = scheduler.moving();
        out.refining = scheduler.refining();
        out.preparing = scheduler.preparing();
        out.settling = scheduler.unsettled() || (latest != nullptr && latest->statistics.update.degraded);
        out.posted_revision = posted_revision;
        out.light_revision = light_revision;
        if (latest != nullptr) {
            // Edits since then that leave light alone leave the picture true.
            out.shown_revision = latest_revision >= light_revision ? posted_revision : latest_revision;
        }
        out.phase = solving ? phase : std::string();
        out.fraction = solving ? fraction : 0.0;
        if (solving && scheduler.running()) {
            out.elapsed_seconds = seconds(now - started);
            out.remaining_seconds = estimate_remaining(out.elapsed_seconds, fraction);
        } else if (!solving) {
            out.elapsed_seconds = seconds(last_duration);
        }
        out.message = out.state == SessionStatus::State::Failed ? message : std::string();
        return out;
    }

    // Engine thread only.
    Scene scene;
    std::uint64_t revision = 0;
    Clock::time_point last_wake{};
    const std::function<void()> wake;
    const SolveFunction solve;
    const AuditFunction audit; ///< may be empty

    // Guarded by `posting`, which the engine thread never takes: the document as posted, so that post() can tell whether an
    // edit changes light, and a running solve need not be stopped for a new name.
    std::mutex posting;
    Scene posted;

    // Guarded by `mutex`, which is held only to copy state in and out.
    mutable std::mutex mutex;
    std::condition_variable changed;
    bool quit = false;
    Wishes wanted;
    std::optional<Load> pending_load;
    EditMailbox mailbox;
    QualityScheduler scheduler;
    StopFlag running_stop;
    Picture latest;
    std::shared_ptr<const LocalError> error; ///< of `latest`
    std::uint64_t latest_revision = 0;       ///< of the scene that `latest` shows
    std::uint64_t posted_revision = 0;
    std::uint64_t light_revision = 0; ///< newest edit that changed light
    std::string phase;
    double fraction = 0.0;
    std::string message;
    Clock::time_point started{};
    Clock::duration last_duration{};

    std::jthread thread; ///< last: starts when all of the above exists
};

EngineSession::EngineSession(std::function<void()> wake, SolveFunction solve, AuditFunction audit)
    : impl_(std::make_unique<Impl>(std::move(wake), std::move(solve), std::move(audit))) {}
EngineSession::~EngineSession() = default;

void EngineSession::load(Scene scene, std::uint64_t revision, std::shared_ptr<const Solution> stored) {
    impl_->load(std::move(scene), revision, std::move(stored));
}
void EngineSession::prepare() {
    impl_->steer([this] { impl_->scheduler.on_prepare(); });
}
void EngineSession::post(const SceneEdit& edit, std::uint64_t revision, bool in_gesture) {
    impl_->post(edit, revision, in_gesture);
}
void EngineSession::end_gesture() {
    impl_->steer([this] { impl_->scheduler.on_gesture_end(); });
}
void EngineSession::cancel() {
    impl_->steer([this] { impl_->scheduler.on_cancel(); });
}
void EngineSession::resume() {
    impl_->steer([this] { impl_->scheduler.on_resume(); });
}

void EngineSession::keep_landings(bool on) {
    impl_->steer([this, on] {
        impl_->wanted.landings = on;
        impl_->ask_for_wishes();
    });
}
void EngineSession::keep_insides(bool on) {
    impl_->steer([this, on] {
        impl_->wanted.insides = on;
        impl_->drop_insides();
        impl_->ask_for_wishes();
    });
}

std::shared_ptr<const Solution> EngineSession::latest() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->latest;
}
EngineSession::Shown EngineSession::shown() const {
    const std::lock_guard lock(impl_->mutex);
    return {impl_->latest, impl_->error, impl_->latest_revision};
}
SessionStatus EngineSession::status() const { return impl_->status(); }

} // namespace atrium

#include "engine/session/quality_scheduler.h"

#include <utility>

namespace atrium {

void QualityScheduler::on_load(bool has_picture, bool complete) {
    needed_ = !has_picture;
    updatable_ = false;
    unsettled_ = false;
    refining_ = false;
    complete_ = complete;
    cancelled_ = false;
    failed_ = false;
    in_gesture_ = false;
    audit_due_ = false;
    prepare_ = Prepare::No;
    abandoned_ = running_;
}

void QualityScheduler::on_prepare() {
    if (complete_ && !updatable_ && !needed_ && prepare_ == Prepare::No) {
        prepare_ = Prepare::Wanted;
    }
}

void QualityScheduler::on_edit(Time now, bool changes_light, bool in_gesture) {
    last_edit_ = now;
    in_gesture_ = in_gesture;
    if (changes_light) {
        needed_ = true;
        complete_ = false;
        audit_due_ = false;
        prepare_ = prepare_ == Prepare::Wanted ? Prepare::No : prepare_; // the solve of the edit does that, too
        cancelled_ = false;
        failed_ = false;
    }
}

void QualityScheduler::on_gesture_end() { in_gesture_ = false; }

void QualityScheduler::on_cancel() {
    audit_due_ = false;
    if (running_ && running_kind_ == Kind::Audit && !needed_) {
        stopping_ = true; // the light is complete all the same
        return;
    }
    if (prepare_ != Prepare::No && !needed_) {
        prepare_ = prepare_ == Prepare::Wanted ? Prepare::No : Prepare::Stopping;
        return; // likewise
    }
    if (running_ || needed_) {
        cancelled_ = true;
        stopping_ = running_;
    }
}

void QualityScheduler::on_resume() {
    cancelled_ = false;
    failed_ = false;
    if (running_ ? stopping_ : !complete_ && !refining_) { // what refines goes on by itself
        needed_ = true;
    }
}

void QualityScheduler::on_started(Kind kind) {
    running_ = true;
    running_kind_ = kind;
    if (kind == Kind::Audit) {
        audit_due_ = false;
    } else {
        prepare_ = prepare_ == Prepare::Wanted && !needed_ ? Prepare::Running : Prepare::No;
        needed_ = false;
    }
}

void QualityScheduler::on_finished(Outcome outcome, bool updatable, bool audit) {
    const Kind kind = std::exchange(running_kind_, Kind::Full);
    running_ = false;
    stopping_ = false;
    if (std::exchange(abandoned_, false)) {
        return; // nothing that it says is about the present document
    }
    if (kind == Kind::Audit) {
        return; // known or not, the light is what it was
    }
    if (std::exchange(prepare_, Prepare::No) != Prepare::No && outcome != Outcome::Final) {
        return; // likewise
    }
    switch (outcome) {
    case Outcome::Audited: break;
    case Outcome::Final:
        updatable_ = updatable;
        unsettled_ = false;
        refining_ = false;
        if (!needed_) {
            complete_ = true;
            cancelled_ = false; // it was done before it heard
            audit_due_ = audit;
        }
        break;
    case Outcome::Hurried:
        unsettled_ = true;
        refining_ = false;
        break;
    case Outcome::Settled:
        unsettled_ = false;
        refining_ = true;
        break;
    case Outcome::Unfit:
        updatable_ = false;
        refining_ = false;
        needed_ = true;
        break;
    case Outcome::Stopped:
        unsettled_ = unsettled_ || kind != Kind::Full;
        if (cancelled_ && !unsettled_ && !refining_) {
            needed_ = true; // still wanted, once it may go on
        }
        if (kind == Kind::Full && !cancelled_ && !needed_) {
            refining_ = false; // it stopped by itself: nothing better is to be had
        }
        break;
    case Outcome::Failed:
        // An edit made meanwhile may well have cured it: then the next solve runs, else it would fail the same way.
        failed_ = !needed_;
        needed_ = true;
        break;
    }
}

void QualityScheduler::on_failure() {
    failed_ = true;
    needed_ = true;
}

QualityScheduler::Kind QualityScheduler::kind() const {
    if (prepare_ == Prepare::Wanted && !needed_ && !unsettled_) {
        return Kind::Full;
    }
    if (audit_due_ && !needed_ && !unsettled_ && !refining_) {
        return Kind::Audit;
    }
    if (!updatable_ || !(needed_ || unsettled_)) {
        return Kind::Full;
    }
    return needed_ ? Kind::Hurried : Kind::Settle; // a quick answer first, whatever the edit was
}

QualityScheduler::Time QualityScheduler::start_time() const {
    if (running_ || cancelled_ || failed_ ||
        !(needed_ || unsettled_ || refining_ || audit_due_ || prepare_ == Prepare::Wanted)) {
        return Time::max();
    }
    return needed_ || audit_due_ || !in_gesture_ ? Time::min() : last_edit_ + kRest;
}

QualityScheduler::Time QualityScheduler::stop_time() const {
    if (!running_) {
        return Time::max();
    }
    if (abandoned_ || cancelled_) {
        return Time::min();
    }
    if (running_kind_ == Kind::Hurried) {
        return Time::max(); // it is short
    }
    if (running_kind_ == Kind::Audit) {
        return needed_ || stopping_ ? Time::min() : Time::max();
    }
    if (prepare_ == Prepare::Stopping || (needed_ && (!in_gesture_ || updatable_))) {
        return Time::min();
    }
    return needed_ ? last_edit_ + kRest : Time::max();
}

QualityScheduler::State QualityScheduler::state() const {
    if (failed_) {
        return State::Failed;
    }
    if (cancelled_) {
        return State::Stopped;
    }
    return (running_ && !abandoned_ && running_kind_ != Kind::Audit) || needed_ || unsettled_ || refining_ ? State::Solving
                                                                                                           : State::Idle;
}

} // namespace atrium

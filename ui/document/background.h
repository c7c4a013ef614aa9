// Work off the UI thread with its answer back on it, and nothing if the asker is gone by then.
#pragma once

#include "engine/base/result.h"

#include <QFutureWatcher>
#include <QPromise>
#include <QThreadPool>

#include <exception>
#include <memory>
#include <new>
#include <utility>

namespace atrium::ui {

/// Runs `work` (returns a Result<T>; any thread) on the global pool, then `done(Result<T>)` on the UI thread from its event
/// loop. `done` is not called once `owner` is destroyed. Exceptions of `work` become errors. UI thread only.
template <class Work, class Done> void run_in_background(QObject* owner, Work work, Done done) {
    using R = decltype(work());
    auto promise = std::make_shared<QPromise<std::shared_ptr<R>>>();
    auto* watcher = new QFutureWatcher<std::shared_ptr<R>>(owner);
    QObject::connect(watcher, &QFutureWatcherBase::finished, owner, [watcher, done = std::move(done)]() mutable {
        const std::shared_ptr<R> result = watcher->result();
        watcher->deleteLater();
        done(std::move(*result));
    });
    promise->start();
    watcher->setFuture(promise->future());
    QThreadPool::globalInstance()->start([promise, work = std::move(work)]() mutable {
        std::shared_ptr<R> result;
        try {
            result = std::make_shared<R>(work());
        } catch (const std::bad_alloc&) {
            result = std::make_shared<R>(fail({}, {}, "there is not enough memory", "Close other programs and try again."));
        } catch (const std::exception& e) {
            result = std::make_shared<R>(fail({}, {}, e.what()));
        }
        promise->addResult(std::move(result));
        promise->finish();
    });
}

} // namespace atrium::ui

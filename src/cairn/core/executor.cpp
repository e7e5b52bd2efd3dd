// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/executor.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// What is made of one item on its way.
struct Slot {
  std::shared_ptr<void> item;
  std::exception_ptr failure;  // thrown when its turn comes, as one thread would
};

/// What was done before a publish() is seen after a acquire() that follows it. TBB orders its tasks anyway;
/// this says so where the thread sanitizer, which does not see into TBB, looks.
class Handover {
 public:
  void publish() { turns_.fetch_add(1, std::memory_order_acq_rel); }
  void acquire() const { (void)turns_.load(std::memory_order_acquire); }

 private:
  std::atomic<unsigned> turns_ = 0;
};

/// The three stages of ordered_pipeline. No exception leaves them: TBB would not free the items on their way.
struct Pipeline {
  const std::size_t count;
  const std::function<std::shared_ptr<void>(std::size_t)>& produce;
  const std::function<bool(std::size_t, void*)>& consume;
  std::vector<Slot> slots;  // of the items under way, no more than there are slots, so that none is shared
  std::size_t next = 0;
  std::atomic<bool> stopped = false;  // written by the last stage, read by the first
  std::exception_ptr failure = nullptr;
  mutable Handover handover = {};

  Slot& slot(std::size_t index) { return slots[index % slots.size()]; }

  std::size_t draw(tbb::flow_control& flow) {
    handover.acquire();
    const std::size_t index = stopped ? count : next++;
    if (index >= count) flow.stop();
    handover.publish();
    return index;
  }

  std::size_t make(std::size_t index) {
    handover.acquire();
    if (stopped) return index;
    try {
      slot(index) = {produce(index), nullptr};
    } catch (...) {
      slot(index) = {nullptr, std::current_exception()};
    }
    handover.publish();
    return index;
  }

  void use(std::size_t index) {
    handover.acquire();
    if (stopped) return;
    try {
      const Slot mine = std::exchange(slot(index), {});
      if (mine.failure) std::rethrow_exception(mine.failure);
      if (!consume(index, mine.item.get())) stopped = true;
    } catch (...) {
      failure = std::current_exception();
      stopped = true;
    }
    handover.publish();
  }
};

}  // namespace

struct Executor::Arena {
  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads) {}
  tbb::global_control limit;  // so that more threads than cores can be asked for, as the tests do
  tbb::task_arena arena;
};

Executor::Executor(int threads) : threads_(threads) {
  require(threads >= 1, "an executor needs at least one thread");
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}

Executor::~Executor() = default;

struct Executor::Task::State {
  State(std::function<void()> work_to_do, tbb::task_arena* arena_to_use)
      : work(std::move(work_to_do)), arena(arena_to_use) {}
  std::function<void()> work;
  tbb::task_arena* arena;  // null: no other thread
  tbb::task_group group;
  std::exception_ptr failure = nullptr;
  bool waited = false;
  Handover begun, done;

  void run() {
    begun.acquire();
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    done.publish();
  }

  void wait() {
    if (std::exchange(waited, true)) return;
    if (arena != nullptr) {
      arena->execute([this] { group.wait(); });
      done.acquire();
    } else {
      run();
    }
  }
};

Executor::Task::Task(std::unique_ptr<State> state) : state_(std::move(state)) {}
Executor::Task::Task(Task&&) noexcept = default;

Executor::Task::~Task() {
  if (state_ && state_->arena != nullptr) state_->wait();
}

void Executor::Task::wait() {
  state_->wait();
  if (state_->failure) std::rethrow_exception(state_->failure);
}

Executor::Task Executor::start(std::function<void()> work) const {
  auto state = std::make_unique<Task::State>(std::move(work), arena_ ? &arena_->arena : nullptr);
  Task::State* running = state.get();
  running->begun.publish();
  if (arena_) arena_->arena.execute([running] { running->group.run([running] { running->run(); }); });
  return Task(std::move(state));
}

void Executor::for_each(std::size_t count, const std::function<void(std::size_t)>& body) const {
  if (!arena_) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  Handover begun, done;
  begun.publish();
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
    begun.acquire();
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    done.publish();
  };
  const auto loop = [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), run); };
  // Isolated: a loop within a pipeline's consumer waits for its own items only, not for another frame's.
  arena_->arena.execute([&] { tbb::this_task_arena::isolate(loop); });
  done.acquire();
}

void Executor::for_each_chunk(std::size_t count, std::size_t grain,
                              const std::function<void(std::size_t, std::size_t)>& body) const {
  require(grain > 0, "chunks need a grain above 0");
  const std::size_t chunks = (count + grain - 1) / grain;
  for_each(chunks, [&](std::size_t c) { body(c * grain, std::min(count, (c + 1) * grain)); });
}

void Executor::run_pipeline(std::size_t count,
                            const std::function<std::shared_ptr<void>(std::size_t)>& produce,
                            const std::function<bool(std::size_t, void*)>& consume) const {
  if (!arena_) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!consume(i, produce(i).get())) return;
    }
    return;
  }
  const std::size_t under_way = 2 * static_cast<std::size_t>(threads_);
  Pipeline pipeline{count, produce, consume, std::vector<Slot>(under_way)};
  using tbb::filter_mode;
  using Index = std::size_t;
  const auto draw = [&](tbb::flow_control& flow) { return pipeline.draw(flow); };
  const auto make = [&](Index index) { return pipeline.make(index); };
  const auto use = [&](Index index) { pipeline.use(index); };
  pipeline.handover.publish();
  arena_->arena.execute([&] {
    tbb::parallel_pipeline(under_way, tbb::make_filter<void, Index>(filter_mode::serial_in_order, draw) &
                                          tbb::make_filter<Index, Index>(filter_mode::parallel, make) &
                                          tbb::make_filter<Index, void>(filter_mode::serial_in_order, use));
  });
  pipeline.handover.acquire();
  if (pipeline.failure) std::rethrow_exception(pipeline.failure);
}

}  // namespace cairn

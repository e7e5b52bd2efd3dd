// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace cairn {

/// Runs loops on a fixed number of threads. The program makes one and passes it down. With one thread every
/// call is a plain loop. What an item computes must not depend on which thread runs it or when; then results
/// are the same at any number of threads, because they are stored by item and reduced in order.
class Executor {
 public:
  /// Uses `threads` threads, at least 1; throws PreconditionError otherwise.
  explicit Executor(int threads = 1);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  /// Calls body(i) for i in [0, count), in any order. The first exception thrown is rethrown here.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& body) const;

  /// Calls body(begin, end) for chunks of `grain` items that do not depend on the number of threads.
  void for_each_chunk(std::size_t count, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& body) const;

  /// Returns the results of produce(i) for i in [0, count), in order.
  template <class Result, class Produce>
  [[nodiscard]] std::vector<Result> map(std::size_t count, const Produce& produce) const {
    std::vector<Result> results(count);
    for_each(count, [&](std::size_t i) { results[i] = produce(i); });
    return results;
  }

  /// Holds a computation that runs beside the caller, from its start until it is waited for.
  class Task {
   public:
    Task(Task&&) noexcept;
    Task& operator=(Task&&) = delete;
    /// Waits for the computation; an exception that it threw is lost.
    ~Task();
    /// Waits until the computation is done and rethrows what it threw. May be called once.
    void wait();

   private:
    friend class Executor;
    struct State;
    explicit Task(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
  };

  /// Starts a computation. With one thread it runs when it is waited for; so it must neither read what the
  /// caller changes meanwhile nor change what the caller reads. The executor must outlive the task.
  [[nodiscard]] Task start(std::function<void()> work) const;

  /// Produces items ahead, in parallel, and consumes them one after the other in order: for decoding and
  /// features while another thread tracks. `consume` returns false to stop early; at most `2 * threads` items
  /// exist at a time. An exception of `produce` is rethrown when that item's turn comes: the items before it
  /// are consumed, those after it are not.
  template <class Item>
  void ordered_pipeline(std::size_t count, const std::function<Item(std::size_t)>& produce,
                        const std::function<bool(std::size_t, Item&&)>& consume) const {
    run_pipeline(
        count, [&](std::size_t i) { return std::shared_ptr<void>(std::make_shared<Item>(produce(i))); },
        [&](std::size_t i, void* item) { return consume(i, std::move(*static_cast<Item*>(item))); });
  }

 private:
  void run_pipeline(std::size_t count, const std::function<std::shared_ptr<void>(std::size_t)>& produce,
                    const std::function<bool(std::size_t, void*)>& consume) const;

  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace cairn

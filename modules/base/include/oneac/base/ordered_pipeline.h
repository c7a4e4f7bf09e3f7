#pragma once

#include "oneac/base/task_queue.h"

#include <cstddef>
#include <deque>
#include <exception>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace oneac {

/// Maps items on several threads and hands the results on in the order of the input, so that the
/// outcome does not depend on the number of threads.
///
/// An exception of `next` or `map` comes out when everything before it has been consumed.
///
/// @param next     called on this thread; the next item, or nothing at the end
/// @param map      called on a worker; a pure function of the item
/// @param consume  called on this thread with each result in order; returning false stops
/// @param threads  number of items mapped at once, at least 1; 1 runs everything on this thread.
///                 Up to twice as many are waiting or done, so that one that takes long holds up
///                 nobody
template <class Next, class Map, class Consume>
void ordered_pipeline(Next&& next, Map&& map, Consume&& consume, int threads) {
  if (threads <= 1) {
    while (auto item = next()) {
      if (!consume(map(std::move(*item)))) return;
    }
    return;
  }
  using Item = typename std::decay_t<decltype(next())>::value_type;
  using Result = std::decay_t<decltype(map(std::declval<Item>()))>;
  std::deque<std::future<Result>> in_flight;
  bool more = true;
  std::exception_ptr fault;  // of `next`: what is in flight comes first
  const auto most = 2 * static_cast<std::size_t>(threads);
  TaskQueue queue(threads);  // ends before what its tasks use
  const auto next_item = [&]() -> decltype(next()) {
    try {
      return next();
    } catch (...) {
      fault = std::current_exception();
      return std::nullopt;
    }
  };
  const auto fill = [&] {
    while (more && in_flight.size() < most) {
      auto item = next_item();
      more = item.has_value();
      if (!more) return;
      // A std::function is copied, the task and its item are not.
      const auto task = std::make_shared<std::packaged_task<Result()>>(
          [&map, moved = std::move(*item)]() mutable { return map(std::move(moved)); });
      in_flight.push_back(task->get_future());
      queue.add([task] { (*task)(); });
    }
  };
  for (fill(); !in_flight.empty(); fill()) {
    Result result = in_flight.front().get();
    in_flight.pop_front();
    if (!consume(std::move(result))) return;
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace oneac

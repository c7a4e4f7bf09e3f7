#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace oneac {

/// Threads that share loops whose turns do not depend on each other, so that a loop leaves the same
/// behind however many there are.
///
/// The helpers live as long as the object and sleep between loops. One that the machine is slow to
/// wake is not waited for, the others take its turns.
class Workers {
 public:
  /// One turn: its index, and who takes it, below count(): for memory that turns share one by one.
  using Turn = std::function<void(std::size_t index, std::size_t worker)>;
  /// More have nothing to share in the loops of one frame.
  static constexpr int kMost = 64;

  /// @param threads  at work at once, the caller among them; up to kMost are used, below 2 the
  ///                 caller works alone. Where the machine has no more threads, fewer are
  explicit Workers(int threads = 1);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Threads at work at once, the caller among them; at least 1.
  [[nodiscard]] std::size_t count() const { return helpers_.size() + 1; }
  /// Takes the turn of every index below `turns`, and returns when all are done. Results have to be
  /// the same in any order. Not from inside a turn, nor from two threads at once.
  /// @throws what the first turn, by index, has thrown; those behind it may not have been taken
  void share(std::size_t turns, const Turn& turn);
  /// CPU time that the helpers have used so far [ms]; between loops.
  [[nodiscard]] double helpers_cpu_ms() const;

 private:
  void help(std::size_t worker);
  /// Takes turns until none is left.
  void work(std::size_t worker);
  void note_fault(std::size_t index);

  std::vector<std::thread> helpers_;
  std::vector<double> cpu_ms_;  ///< per helper, when it was last at work
  mutable std::mutex mutex_;
  std::condition_variable begun_, left_;
  const Turn* turn_ = nullptr;
  std::size_t turns_ = 0, chunk_ = 1;
  std::size_t loop_ = 0;  ///< number of the loop
  std::size_t busy_ = 0;  ///< helpers at work
  bool is_open_ = false;  ///< the loop: there may be turns left
  bool ends_ = false;
  std::atomic<std::size_t> next_{0};  ///< first turn that nobody has taken
  std::size_t faulty_ = 0;            ///< index of the turn that threw
  std::exception_ptr fault_;
};

}  // namespace oneac

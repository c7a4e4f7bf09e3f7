#pragma once

#include "oneac/features/ac_tracker.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>

namespace oneac::internal {

/// Where each live track was, frame by frame, with the affinity composed from its start.
class TrackHistory {
 public:
  /// A new track at a frame.
  void start(std::uint64_t track, std::size_t frame, const Eigen::Vector2d& u);
  /// The next sighting of a track; A from its last one. @pre the track was started
  void extend(std::uint64_t track, std::size_t frame, const Eigen::Vector2d& u,
              const Eigen::Matrix2d& A);
  /// A track that has come to its end.
  void end(std::uint64_t track) { tracks_.erase(track); }
  /// Ends all tracks not seen in the frame.
  void end_all_but(std::size_t frame);
  void clear() { tracks_.clear(); }

  [[nodiscard]] std::optional<AffineCorrespondence> between(std::uint64_t track, std::size_t frame1,
                                                            std::size_t frame2) const;
  [[nodiscard]] std::size_t size() const { return tracks_.size(); }

 private:
  struct Sighting {
    std::size_t frame;
    Eigen::Vector2d u;
    Eigen::Matrix2d A_here_first;
  };
  std::unordered_map<std::uint64_t, std::deque<Sighting>> tracks_;
};

}  // namespace oneac::internal

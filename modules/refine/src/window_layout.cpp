// Who measures what, and what adds to which block of a window's equations.

#include "window_equations.h"
#include "window_problem.h"

#include <utility>

namespace oneac {

using internal::block_at;
using internal::PoseDerivative;

void WindowEquations::set(const SlidingWindow& window, const WindowRefineOptions& options) {
  views_ = window.views.size();
  c2_ = options.loss_sigmas * options.loss_sigmas;
  landmarks_.assign(window.landmarks.size(), {});
  rows_.clear();
  links_.clear();
  priors_.clear();
  derivatives_.clear();
  couplings_.clear();
  add_columns(window);
  add_rows(window, options);
  add_priors(window, options);
  add_blocks();
  H_.resize(blocks_.size());
  g_.resize(free_views_);
}

void WindowEquations::add_columns(const SlidingWindow& window) {
  free_.clear();
  free_views_ = 0;
  for (const WindowView& view : window.views) {
    free_.push_back(view.fixed ? kNone : free_views_++);
  }
}

void WindowEquations::add_rows(const SlidingWindow& window, const WindowRefineOptions& options) {
  const std::size_t count = window.observations.size();
  std::vector<char> in_front(count, 0);
  workers_.share(count, [&](std::size_t i, std::size_t) {
    in_front[i] = is_in_front(window, window.observations[i]) ? 1 : 0;
  });
  seen_by_.clear();
  for (std::size_t i = 0; i < count; ++i) seen_by_.add(window.observations[i].landmark, i);
  seen_by_.sort(window.landmarks.size());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Landmark& landmark = landmarks_[i];
    landmark.anchor = window.landmarks[i].anchor;
    landmark.first_row = rows_.size();
    landmark.first_link = landmark.last_link = links_.size();
    bool second_view = false;
    for (const std::size_t* k = seen_by_.begin(i); k != seen_by_.end(i); ++k) {
      const WindowObservation& seen = window.observations[*k];
      if (in_front[*k] == 0) continue;
      second_view = second_view || seen.view != landmark.anchor;
      rows_.push_back({seen.x, 1.0 / point_sigma(seen, window, options), seen.view, kNone});
    }
    if (!second_view) rows_.resize(landmark.first_row);  // a ray without depth says nothing
    landmark.last_row = rows_.size();
    if (!second_view) continue;
    landmark.anchor_link = link_of(landmark, landmark.anchor);
    for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
      rows_[k].link = link_of(landmark, rows_[k].view);
    }
  }
}

std::size_t WindowEquations::link_of(Landmark& landmark, std::size_t view) {
  const std::size_t free = free_[view];
  if (free == kNone) return kNone;
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
    if (links_[k].view == free) return k;
  }
  links_.push_back({{}, {}, free});
  landmark.last_link = links_.size();
  return landmark.last_link - 1;
}

void WindowEquations::add_priors(const SlidingWindow& window, const WindowRefineOptions& options) {
  for (std::size_t i = 0; i + 1 < window.views.size(); ++i) {
    if (window.views[i].fixed && window.views[i + 1].fixed) continue;
    priors_.push_back({i, planar_prior(window, i, options)});
  }
}

void WindowEquations::add_blocks() {
  blocks_.clear();
  for (std::size_t row = 0; row < free_views_; ++row) {
    for (std::size_t column = 0; column <= row; ++column) blocks_.push_back({row, column});
  }
  terms_.resize(rows_.size());
  reduced_.resize(landmarks_.size());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    add_derivatives(landmarks_[i]);
    add_couplings(i);
  }
  derivatives_.sort(blocks_.size());
  couplings_.sort(blocks_.size());
}

void WindowEquations::add_derivatives(const Landmark& landmark) {
  const auto add = [&](std::size_t link1, const PoseDerivative& by1, std::size_t link2,
                       const PoseDerivative& by2, const double* r) {
    if (link1 == kNone || link2 == kNone) return;
    const std::size_t one = links_[link1].view, two = links_[link2].view;
    if (one >= two) {
      derivatives_.add(block_at(one, two), {&by1, &by2, r});
    } else {
      derivatives_.add(block_at(two, one), {&by2, &by1, r});
    }
  };
  for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
    if (rows_[k].view == landmark.anchor) continue;
    const RowTerms& terms = terms_[k];
    const std::size_t view = rows_[k].link, anchor = landmark.anchor_link;
    add(view, terms.by_view, view, terms.by_view, terms.here.r);
    add(anchor, terms.by_anchor, anchor, terms.by_anchor, terms.here.r);
    add(view, terms.by_view, anchor, terms.by_anchor, terms.here.r);
  }
}

void WindowEquations::add_couplings(std::size_t i) {
  for (std::size_t k = landmarks_[i].first_link; k < landmarks_[i].last_link; ++k) {
    for (std::size_t other = landmarks_[i].first_link; other <= k; ++other) {
      const internal::WindowLink *lower = &links_[k], *upper = &links_[other];
      if (lower->view < upper->view) std::swap(lower, upper);
      couplings_.add(block_at(lower->view, upper->view),
                     {&lower->reduced, &upper->reduced, reduced_[i].g});
    }
  }
}

}  // namespace oneac

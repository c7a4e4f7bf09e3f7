#pragma once

#include "course.h"
#include "two_view.h"

#include "oneac/refine/two_view.h"

namespace oneac {

/// A pair of far points alone often has two poses that explain it as well (a far plane's second
/// homography, tracks that slip along poles): one where the two views were found, the other near
/// the vehicle's course. A pair whose direction is no surprise is returned as it is. Else both are
/// refined over those to go by, the second with the course as prior, and the posterior of the two
/// decides, with costs as negative log-likelihoods. The covariance is that of the mixture, so that
/// a choice which is not sure says so. A direction that no wheels take is out of the question,
/// however many points want it: far ones, and those of who crosses, do.
/// @param told  those to go by, one per correspondence
/// @param threshold_px  of the inliers of a pose that is changed
[[nodiscard]] TwoView in_likelier_basin(TwoView found, const std::vector<bool>& told,
                                        const Course& course, const RefineOptions& refine,
                                        double threshold_px);

}  // namespace oneac

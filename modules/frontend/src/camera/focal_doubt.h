#pragma once

namespace oneac {

/// How far a given focal length is to be doubted for what a drive says of it.
///
/// A calibration is either good, its focal length right, or poor (of a resized image, another lens,
/// guessed): one in ten, off by 5 % (1σ). What the drive says weighs the two by Bayes' rule, and
/// the doubt is the root mean square of ln(true f / given f) over both. So it rises with what
/// contradicts instead of waiting for a threshold, and vanishes where the drive confirms.
///
/// @param log_focal  ln(f of the drive / given f)
/// @param sigma      1σ of it, above 0
/// @return relative 1σ; 0 where an argument is not finite or sigma is not above 0
[[nodiscard]] double focal_doubt(double log_focal, double sigma);

}  // namespace oneac

#include "feature_pictures.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/number_text.h"
#include "oneac/evaluation/statistics.h"
#include "oneac/report/overlay.h"

namespace oneac::app {
namespace {

// Ends of the colours: what a well textured patch reaches, and what the tracker refuses at last.
constexpr double kGoodResidual = 0.005, kPoorResidual = 0.05;
constexpr double kGoodSigma = 0.01, kPoorSigma = 0.05;
constexpr std::size_t kFewest = 10;  // values that make a median

}  // namespace

void draw_tracks(const ImageView& image, const TrackedPair& pair,
                 const std::filesystem::path& png) {
  std::vector<Mark> marks;
  for (const Correspondence& ac : pair.correspondences) {
    const double sigma = pair.standing ? 0.0 : ac.affine_sigma;
    marks.push_back({ac.x1, ac.x2, ac.A, (sigma - kGoodSigma) / (kPoorSigma - kGoodSigma)});
  }
  write_file_atomically(png, overlay_png(image, marks));
}

void draw_regions(const GreyImage& image, const FeatureStatistics& statistics,
                  const std::filesystem::path& png) {
  constexpr int kColumns = FeatureStatistics::kColumns, kRows = FeatureStatistics::kRows;
  std::vector<TintedField> fields;
  for (int i = 0; i < kRows * kColumns; ++i) {
    const std::vector<double>& residuals = statistics.residuals(i / kColumns, i % kColumns);
    fields.emplace_back();
    if (residuals.size() < kFewest) continue;
    const double residual = percentile(residuals, 50.0);
    fields.back() = {fixed_text(residual, 3),
                     (residual - kGoodResidual) / (kPoorResidual - kGoodResidual)};
  }
  write_file_atomically(png, tinted_png(image.view(), kRows, kColumns, fields));
}

}  // namespace oneac::app

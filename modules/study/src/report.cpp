#include "oneac/study/report.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/number_text.h"
#include "oneac/report/plot.h"
#include "oneac/report/table.h"

namespace oneac {
namespace {

constexpr double kHeight = 350.0;  // [px] of 540 px of width
constexpr int kDigits = 8;         // in the CSV: enough to draw and compare, short enough to read

[[nodiscard]] std::string letter(std::string_view id) {
  return "(" + std::string(id) + ") ";
}

[[nodiscard]] std::string y_label(StudyMetric metric) {
  return "mean " + std::string(metric_name(metric)) + " error [°]";
}

[[nodiscard]] std::string subtitle_of(StudySweep sweep, DataUse data_use) {
  const std::string noise = sweep == StudySweep::kNoise       ? ""
                            : sweep == StudySweep::kSlope     ? "; noise 0.2 px, 0.2°, 0.2 %"
                            : sweep == StudySweep::kWallAngle ? "; noise 1 px, 5°, 5 %"
                                                              : "; noise 1 px, 1°, 1 %";
  return (data_use == DataUse::kAll ? "every method uses the same four correspondences"
                                    : "1AC uses one correspondence, 2AC two, 4PC four") +
         noise;
}

}  // namespace

std::string csv_of(const ExperimentResult& result, const Figure& figure, std::size_t trials) {
  std::string csv = std::string(sweep_column(result.experiment->sweep)) +
                    ",method,trials,failures,mean_deg,median_deg,p95_deg\n";
  for (const PointResult& point : result.points) {
    for (const StudyMethodResult& method : point.methods) {
      const ErrorStatistics& errors = method.of(figure.metric);
      csv += csv_line(
          {fixed_text(point.value, 1), std::string(method.method->label), std::to_string(trials),
           std::to_string(trials - method.solved), significant_text(errors.mean, kDigits),
           significant_text(errors.median, kDigits), significant_text(errors.p95, kDigits)});
    }
  }
  return csv;
}

std::string svg_of(const ExperimentResult& result, const Figure& figure, DataUse data_use) {
  Plot plot;
  plot.height = kHeight;
  plot.from_zero = true;
  plot.title = letter(figure.id) + std::string(result.experiment->title);
  plot.subtitle = subtitle_of(result.experiment->sweep, data_use);
  plot.x_label = std::string(sweep_label(result.experiment->sweep));
  plot.y_label = y_label(figure.metric);
  for (const StudyMethod method : result.experiment->methods) {
    plot.series.push_back({std::string(method->label), {}, {}, Pen::kMarkers});
  }
  for (const PointResult& point : result.points) {
    for (std::size_t m = 0; m < point.methods.size(); ++m) {
      plot.series[m].x.push_back(point.value);
      plot.series[m].y.push_back(point.methods[m].of(figure.metric).mean);
    }
  }
  return plot_document(plot);
}

std::vector<std::filesystem::path> write_study(const StudyResult& result,
                                               const std::vector<StudyResult>& readings,
                                               const std::filesystem::path& folder) {
  require_writable_folder(folder);
  std::vector<std::filesystem::path> written;
  const auto write = [&](const std::string& name, const std::string& content) {
    written.push_back(folder / name);
    write_file_atomically(written.back(), content);
  };
  for (const Figure& figure : wanted_figures(result.options)) {
    const ExperimentResult* experiment = result.find(figure.experiment);
    if (experiment == nullptr) continue;
    write(figure.name() + ".csv", csv_of(*experiment, figure, result.options.trials));
    write(figure.name() + ".svg", svg_of(*experiment, figure, result.options.data_use));
  }
  write("summary.md", summary_of(result, readings));
  return written;
}

}  // namespace oneac

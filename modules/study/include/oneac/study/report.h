#pragma once

#include "oneac/study/study.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// A figure's numbers: <sweep>,method,trials,failures,mean_deg,median_deg,p95_deg; a row per point
/// and method. Means are over the solved trials.
[[nodiscard]] std::string csv_of(const ExperimentResult& result, const Figure& figure,
                                 std::size_t trials);
/// The means of it as a picture.
[[nodiscard]] std::string svg_of(const ExperimentResult& result, const Figure& figure,
                                 DataUse data_use);
/// Set-up, judged claims, how they fare under each of the readings (see run_readings; may be none)
/// and a table per experiment, Markdown.
[[nodiscard]] std::string summary_of(const StudyResult& result,
                                     const std::vector<StudyResult>& readings);

/// Writes <figure>.csv and <figure>.svg for each wanted figure, and summary.md; existing files are
/// replaced. Figures whose experiment was not finished are left out.
/// @returns the files written, in order
/// @throws OutputError, InputError as write_file_atomically and require_writable_folder
std::vector<std::filesystem::path> write_study(const StudyResult& result,
                                               const std::vector<StudyResult>& readings,
                                               const std::filesystem::path& folder);

}  // namespace oneac

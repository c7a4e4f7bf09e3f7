#include "calibration/yaml_calibrations.h"

#include "calibration/calibration_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <optional>

namespace oneac {
namespace {

using Shared = std::shared_ptr<const FlatDocument>;

/// One camera of a document.
struct Reader {
  Shared document;
  CalibrationPlace place;

  Reader(Shared of, const std::string& section)
      : document(std::move(of)), place(document->file, "section [" + section + "]") {}

  [[nodiscard]] std::vector<double> numbers(const std::string& path) const {
    return place.numbers(path, document->words(path));
  }
  [[nodiscard]] double number(const std::string& path, const std::string& cure) const {
    const auto values = numbers(path);
    if (values.size() != 1) place.fail(path + " is missing or not one number", cure);
    return values.front();
  }
  /// Zero for a coefficient that is left out.
  [[nodiscard]] double coefficient(const std::string& path) const {
    return document->has(path) ? number(path, "give one number") : 0.0;
  }
  void read_size(const std::string& width, const std::string& height, PinholeCamera& camera) const {
    if (!document->has(width) && !document->has(height)) return;
    constexpr const char* kCure = "give the size of its images";
    set_size({number(width, kCure), number(height, kCure)}, width + ", " + height, place, camera);
  }
};

/// The first of the paths that exists; empty: none.
std::string first_of(const FlatDocument& document, const std::vector<std::string>& paths) {
  const auto found = std::find_if(paths.begin(), paths.end(),
                                  [&](const std::string& path) { return document.has(path); });
  return found == paths.end() ? "" : *found;
}

/// "K" or "K.data", whichever the document has.
std::string matrix_path(const FlatDocument& document, const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  for (const std::string& name : names) {
    paths.push_back(name + ".data");
    paths.push_back(name);
  }
  return first_of(document, paths);
}

const std::vector<std::string> kMatrices{
    "camera_matrix", "Camera_Matrix", "cameraMatrix", "intrinsic_matrix", "K", "k"};
const std::vector<std::string> kLenses{
    "distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "dist_coeffs", "D", "d"};
const std::vector<std::string> kWidths{"image_width", "image_Width", "imageWidth", "width"};
const std::vector<std::string> kHeights{"image_height", "image_Height", "imageHeight", "height"};

std::string lens_model(const FlatDocument& document) {
  const std::string named = document.word("distortion_model");
  if (!named.empty()) return named;
  const std::string fisheye = document.word("fisheye_model");  // OpenCV's calibration program
  return fisheye.empty() || fisheye == "0" || fisheye == "false" ? "plumb_bob" : "fisheye";
}

/// OpenCV's and ROS' names: a matrix K or P and the coefficients of the raw images, or none.
PinholeCamera read_matrices(const Reader& reader, const std::string& matrix,
                            const std::string& lens, const std::string& model) {
  const FlatDocument& document = *reader.document;
  PinholeCamera camera;
  set_matrix(reader.numbers(matrix), matrix, reader.place, camera);
  const std::string width = first_of(document, kWidths), height = first_of(document, kHeights);
  if (!width.empty() || !height.empty()) {
    reader.read_size(width.empty() ? "image_width" : width,
                     height.empty() ? "image_height" : height, camera);
  }
  if (!lens.empty()) set_lens(model, reader.numbers(lens), reader.place, camera);
  return camera;
}

void add_opencv_and_ros(const Shared& document, CalibrationEntries& entries) {
  const std::string matrix = matrix_path(*document, kMatrices);
  if (matrix.empty()) return;
  const std::string named = document->word("camera_name");
  const std::string section = named.empty() ? "camera" : named;
  const std::string lens = matrix_path(*document, kLenses);
  entries.push_back(
      {section, true, [=] {
         return read_matrices({document, section}, matrix, lens, lens_model(*document));
       }});
  const std::string projection = matrix_path(*document, {"projection_matrix", "P", "p"});
  if (projection.empty()) return;
  entries.push_back({"projection", false, [=] {
                       return read_matrices({document, "projection"}, projection, "", "");
                     }});
}

/// M1 D1 M2 D2 of OpenCV's stereo calibration; LEFT.K LEFT.D RIGHT.K … of ORB-SLAM's stereo.
void add_stereo(const Shared& document, CalibrationEntries& entries) {
  struct Names {
    const char *section, *matrix, *lens, *width, *height;
  };
  constexpr std::array<Names, 4> kCameras{
      {{"M1", "M1", "D1", "", ""},
       {"M2", "M2", "D2", "", ""},
       {"LEFT", "LEFT.K", "LEFT.D", "LEFT.width", "LEFT.height"},
       {"RIGHT", "RIGHT.K", "RIGHT.D", "RIGHT.width", "RIGHT.height"}}};
  for (const Names& names : kCameras) {
    const std::string matrix = matrix_path(*document, {names.matrix});
    if (matrix.empty()) continue;
    const std::string lens = matrix_path(*document, {names.lens});
    entries.push_back({names.section, true, [=] {
                         const Reader reader(document, names.section);
                         PinholeCamera camera = read_matrices(reader, matrix, lens, "plumb_bob");
                         reader.read_size(names.width, names.height, camera);
                         return camera;
                       }});
  }
}

/// Kalibr's cam0 …, or EuRoC's sensor.yaml with an empty prefix.
PinholeCamera read_kalibr(const Reader& reader, const std::string& prefix) {
  const FlatDocument& document = *reader.document;
  const std::string model = document.word(prefix + "camera_model");
  if (model != "pinhole") {
    reader.place.fail("the camera model '" + model + "' is not supported",
                      "calibrate as pinhole-radtan or pinhole-equi");
  }
  PinholeCamera camera;
  set_intrinsics(reader.numbers(prefix + "intrinsics"), prefix + "intrinsics", reader.place,
                 camera);
  set_size(reader.numbers(prefix + "resolution"), prefix + "resolution", reader.place, camera);
  const std::string lens =
      first_of(document, {prefix + "distortion_coeffs", prefix + "distortion_coefficients"});
  const std::vector<double> coefficients = reader.numbers(lens);
  const std::string named = document.word(prefix + "distortion_model");
  if (named.empty() && !coefficients.empty()) {
    reader.place.fail("distortion_model is missing, which says what the coefficients mean",
                      "give radtan, equidistant or none");
  }
  set_lens(named.empty() ? "none" : named, coefficients, reader.place, camera);
  return camera;
}

void add_kalibr(const Shared& document, CalibrationEntries& entries) {
  if (document->has("intrinsics") && document->has("camera_model")) {
    entries.push_back({"camera", true, [=] { return read_kalibr({document, "camera"}, ""); }});
  }
  const std::string ending = ".intrinsics";
  for (const auto& [path, words] : document->entries) {
    const bool ends = path.size() > ending.size() &&
                      path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
    const std::string section = ends ? path.substr(0, path.size() - ending.size()) : "";
    if (section.empty() || !document->has(section + ".camera_model")) continue;
    entries.push_back({section, true, [document = document, section] {
                         return read_kalibr({document, section}, section + ".");
                       }});
  }
}

std::vector<double> orb_coefficients(const Reader& reader, const std::string& prefix,
                                     const std::string& model) {
  const auto k = [&](const char* name) { return reader.coefficient(prefix + name); };
  if (model == "KannalaBrandt8") return {k("k1"), k("k2"), k("k3"), k("k4")};
  return {k("k1"), k("k2"), k("p1"), k("p2"), k("k3"), k("k4"), k("k5"), k("k6")};
}

/// ORB-SLAM's settings: "Camera.fx", or "Camera1.fx" since its third version.
PinholeCamera read_orb_slam(const Reader& reader, const std::string& prefix) {
  constexpr const char* kCure = "it needs fx, fy, cx, cy in pixels";
  PinholeCamera camera;
  const auto scalar = [&](const char* name) { return reader.number(prefix + name, kCure); };
  set_intrinsics({scalar("fx"), scalar("fy"), scalar("cx"), scalar("cy")}, prefix + "fx",
                 reader.place, camera);
  reader.read_size("Camera.width", "Camera.height", camera);
  const std::string type = reader.document->word("Camera.type");
  const std::string model = type.empty() ? "PinHole" : type;
  set_lens(model, orb_coefficients(reader, prefix, model), reader.place, camera);
  return camera;
}

void add_orb_slam(const Shared& document, CalibrationEntries& entries) {
  for (const char* section : {"Camera", "Camera1", "Camera2"}) {
    const std::string prefix = std::string(section) + ".";
    if (!document->has(prefix + "fx")) continue;
    // What stereo settings rectify to is for images that ORB-SLAM makes itself.
    const bool offered = matrix_path(*document, {"LEFT.K"}).empty();
    entries.push_back({section, offered, [document = document, section, prefix] {
                         return read_orb_slam({document, section}, prefix);
                       }});
  }
}

bool starts_with(const std::string& text, std::size_t at, const std::string& start) {
  return text.compare(at, start.size(), start) == 0;
}

}  // namespace

CalibrationEntries document_calibrations(const FlatDocument& flat) {
  const auto document = std::make_shared<const FlatDocument>(flat);
  CalibrationEntries entries;
  add_opencv_and_ros(document, entries);
  add_stereo(document, entries);
  add_kalibr(document, entries);
  add_orb_slam(document, entries);
  return entries;
}

bool is_calibration_yaml(const std::filesystem::path& file, const std::string& text) {
  const std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml" || starts_with(text, 0, "%YAML")) return true;
  static const std::vector<std::string> kKeys{
      "camera_matrix:", "cameraMatrix:", "image_width:", "distortion_model:",
      "camera_model:",  "cam0:",         "Camera.fx:",   "Camera1.fx:",
      "Camera.type:",   "intrinsics:",   "M1:",          "distortion_coeffs:"};
  for (std::size_t at = 0; at < text.size();) {
    const auto here = [&](const std::string& key) { return starts_with(text, at, key); };
    if (std::any_of(kKeys.begin(), kKeys.end(), here)) return true;
    const auto end = text.find('\n', at);
    at = end == std::string::npos ? text.size() : end + 1;
  }
  return false;
}

}  // namespace oneac

// SPDX-License-Identifier: Apache-2.0
#include "services/offline/people/load_person.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "services/offline/people/archive.hpp"
#include "services/offline/people/read_obj.hpp"

namespace foretrack {
namespace {

using Side = Skeleton::Side;

// Where the joints are in each model, read off its front and side views and, for the way in which
// the shoulders look, off its sections at their height: (forward, left, up) over the height, left
// first.
struct Row {
  const char* name;
  const char* model;
  Skeleton skeleton;
};

const std::array<Row, 4>& rows() {
  static const std::array<Row, 4> kRows = {{
      {"boy",
       "boyStanding",
       {.shoulder = Side{{{-0.015F, 0.098F, 0.805F}, {0.004F, -0.098F, 0.805F}}},
        .elbow = Side{{{-0.065F, 0.155F, 0.675F}, {-0.020F, -0.137F, 0.650F}}},
        .wrist = Side{{{0.030F, 0.095F, 0.578F}, {0.045F, -0.150F, 0.515F}}},
        .fingertips = Side{{{0.065F, 0.050F, 0.560F}, {0.065F, -0.150F, 0.435F}}},
        .hip = Side{{{0.000F, 0.055F, 0.530F}, {0.000F, -0.055F, 0.530F}}},
        .knee = Side{{{0.005F, 0.065F, 0.285F}, {0.005F, -0.070F, 0.285F}}},
        .ankle = Side{{{-0.020F, 0.070F, 0.050F}, {-0.020F, -0.075F, 0.050F}}},
        .toes = Side{{{0.075F, 0.085F, 0.015F}, {0.075F, -0.088F, 0.015F}}}}},
      {"girl",
       "girlStanding",
       {.shoulder = Side{{{0.011F, 0.090F, 0.795F}, {-0.038F, -0.082F, 0.795F}}},
        .elbow = Side{{{-0.010F, 0.112F, 0.635F}, {-0.010F, -0.105F, 0.635F}}},
        .wrist = Side{{{0.045F, 0.112F, 0.500F}, {0.045F, -0.113F, 0.500F}}},
        .fingertips = Side{{{0.070F, 0.110F, 0.405F}, {0.070F, -0.112F, 0.415F}}},
        .hip = Side{{{0.000F, 0.060F, 0.520F}, {0.000F, -0.040F, 0.520F}}},
        .knee = Side{{{0.023F, 0.045F, 0.285F}, {-0.016F, -0.022F, 0.285F}}},
        .ankle = Side{{{-0.012F, 0.042F, 0.050F}, {-0.042F, -0.003F, 0.050F}}},
        .toes = Side{{{0.085F, 0.045F, 0.015F}, {0.060F, -0.035F, 0.015F}}}}},
      {"man",
       "male03",
       {.shoulder = Side{{{-0.028F, 0.080F, 0.805F}, {-0.046F, -0.115F, 0.805F}}},
        .elbow = Side{{{0.030F, 0.090F, 0.690F}, {0.030F, -0.140F, 0.690F}}},
        .wrist = Side{{{0.050F, -0.050F, 0.720F}, {0.050F, 0.030F, 0.720F}}},
        .fingertips = Side{{{0.050F, -0.100F, 0.740F}, {0.050F, 0.080F, 0.740F}}},
        .hip = Side{{{-0.035F, 0.042F, 0.530F}, {-0.035F, -0.072F, 0.530F}}},
        .knee = Side{{{0.002F, 0.068F, 0.285F}, {-0.033F, -0.071F, 0.285F}}},
        .ankle = Side{{{-0.020F, 0.092F, 0.050F}, {-0.050F, -0.060F, 0.050F}}},
        .toes = Side{{{0.090F, 0.120F, 0.015F}, {0.060F, -0.095F, 0.015F}}},
        .arms_swing = false}},
      {"suit",
       "male02",
       {.shoulder = Side{{{0.057F, 0.118F, 0.800F}, {-0.019F, -0.085F, 0.800F}}},
        .elbow = Side{{{-0.020F, 0.162F, 0.640F}, {-0.085F, -0.115F, 0.670F}}},
        .wrist = Side{{{0.065F, 0.152F, 0.530F}, {0.045F, -0.100F, 0.575F}}},
        .fingertips = Side{{{0.095F, 0.138F, 0.450F}, {0.085F, -0.095F, 0.535F}}},
        .hip = Side{{{0.010F, 0.065F, 0.530F}, {0.010F, -0.050F, 0.530F}}},
        .knee = Side{{{0.005F, 0.108F, 0.285F}, {0.017F, -0.095F, 0.285F}}},
        .ankle = Side{{{-0.025F, 0.155F, 0.050F}, {-0.005F, -0.138F, 0.050F}}},
        .toes = Side{{{0.090F, 0.195F, 0.015F}, {0.100F, -0.200F, 0.015F}}}}},
  }};
  return kRows;
}

std::filesystem::path people_file(const std::filesystem::path& given) {
  if (!given.empty()) return given;
  const char* own = std::getenv("FORETRACK_PEOPLE");
  return own ? own : kPeopleFile;
}

Texture plain(const Eigen::Vector3f& color) {
  RgbImage image{1, 1, {}};
  for (const float channel : color)
    image.rgb.push_back(static_cast<std::uint8_t>(255.0F * std::clamp(channel, 0.0F, 1.0F)));
  return make_texture(image);
}

Texture decode(const std::string& bytes, const std::string& name) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  cv::Mat picture = cv::imdecode(raw, cv::IMREAD_COLOR);
  if (picture.empty()) throw std::runtime_error(name + ": no picture that can be read");
  cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
  return make_texture({picture.cols,
                       picture.rows,
                       {picture.data, picture.data + 3UL * picture.cols * picture.rows}});
}

}  // namespace

std::vector<std::string> person_names() {
  std::vector<std::string> names;
  for (const Row& row : rows()) names.emplace_back(row.name);
  return names;
}

std::shared_ptr<const PersonModel> load_person(const std::string& name,
                                               const std::filesystem::path& file) {
  const auto row =
      std::find_if(rows().begin(), rows().end(), [&](const Row& r) { return name == r.name; });
  if (row == rows().end())
    throw std::invalid_argument(
        fmt::format("no person '{}'; there are {}", name, fmt::join(person_names(), ", ")));
  const auto path = people_file(file);
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error(
        fmt::format("{} is missing: camera images need the people of the Debian package "
                    "sweethome3d-furniture (apt-get install sweethome3d-furniture, or ./run setup)",
                    path.string()));
  const Archive archive(path);
  const std::string folder = fmt::format("reallusion/{}/", row->model);
  std::vector<std::string> names;
  PersonMesh mesh = read_obj(archive.read(folder + row->model + ".obj"), names);
  const auto materials = read_mtl(archive.read(folder + row->model + ".mtl"));
  for (const auto& material_name : names) {
    const auto found = materials.find(material_name);
    const Material material = found == materials.end() ? Material{} : found->second;
    const std::string picture = folder + material.picture;
    mesh.textures.push_back(material.picture.empty() ? plain(material.color)
                                                     : decode(archive.read(picture), picture));
  }
  return std::make_shared<PersonModel>(make_person_model(std::move(mesh), row->skeleton));
}

std::shared_ptr<const PersonModel> person_of(const Scenario& scenario) {
  return scenario.color_images ? load_person(scenario.person) : nullptr;
}

std::vector<std::shared_ptr<const PersonModel>> bystanders_of(const Scenario& scenario) {
  std::vector<std::shared_ptr<const PersonModel>> models;
  if (scenario.color_images)
    for (const auto& bystander : scenario.bystanders)
      models.push_back(load_person(bystander.person));
  return models;
}

}  // namespace foretrack

#include "tests/fuzz/readers.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <variant>
#include <vector>

#include "avoidance/flow_balance/flow_balance.h"
#include "scenes/mesh/mesh_import.h"
#include "scenes/mesh/texture_image.h"
#include "scenes/pose_table.h"
#include "scenes/terrain/heightmap.h"
#include "sim/batch/campaign_file.h"
#include "sim/batch/earlier_batch.h"
#include "sim/config/include.h"
#include "sim/config/input_error.h"
#include "sim/config/reader.h"
#include "sim/evidence/conduct.h"
#include "sim/falsify/falsify_file.h"
#include "sim/fields/invalid_field.h"
#include "sim/link/ardupilot_link.h"
#include "sim/mavlink/frame.h"
#include "sim/record/run_record.h"
#include "sim/record/table.h"
#include "sim/reproduce/paper.h"
#include "sim/scenario/reference_path.h"
#include "sim/scenario/rig.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/sweep_file.h"
#include "tests/sim/record/temporary_folder.h"

/// Called by the leak sanitizer: assimp loses memory when it refuses a file.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

namespace hedgehop::fuzz {
namespace {

void read_scenario(const std::filesystem::path& file) {
  const sim::Scenario scenario = sim::load_scenario(file);
  // A scenario that was read can be written and reads back.
  sim::ErrorList faults("scenario");
  std::set<std::filesystem::path> files;
  sim::parse_tree(sim::to_yaml(scenario), "resolved", faults, files);
  faults.throw_if_any();
}

void read_campaign(const std::filesystem::path& file) {
  for (const std::string& fault : sim::read_batch({file}, {}, {}).faults) {
    if (!fault.ends_with("there is no such file")) throw sim::InputError(fault);  // the corpus has no scenarios
  }
}

/// The part of an earlier batch that `batch --failed-only` reads.
void read_earlier_batch(const std::filesystem::path& file) { sim::reread_batch(file); }

void read_mesh(const std::filesystem::path& file) {
  scenes::Scene scene;
  scenes::mesh::add_imports({{.file = file.string()}}, Eigen::Vector3d::Zero(), scene);
}

/// As the material file of an OBJ is read.
void read_materials(const std::filesystem::path& file) {
  const std::filesystem::path obj = std::filesystem::path(file).replace_extension("obj");
  std::ofstream(obj) << "mtllib " << file.filename().string()
                     << "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n";
  read_mesh(obj);
}

/// As the image of a mesh's material is read.
void read_texture(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  cv::Mat image;
  try {
    image = scenes::mesh::decode_texture(bytes);
  } catch (const scenes::mesh::ImageTooLarge& fault) {
    throw std::invalid_argument(fault.what());
  }
  if (image.empty()) throw std::invalid_argument("no image");
  if (image.type() != CV_8UC3 && image.type() != CV_8UC4) throw std::logic_error("not three or four bytes per pixel");
}

void read_calibration(const std::filesystem::path& file) {
  sim::CameraConfig camera;
  camera.model_kind = sim::CameraConfig::Model::ocam;
  camera.width_px = camera.height_px = 100;  // of the corpus
  camera.calibration = file;
  camera.model();
}

/// As a module's parameters are read when its library has been loaded: a map of any keys, then a struct of its own.
void read_parameters(const std::filesystem::path& file) {
  sim::ErrorList faults("scenario");
  const sim::Node root = sim::load_tree(file, faults);
  avoidance::flow_balance::FlowBalanceConfig config;
  if (root.kind == sim::Node::Kind::map) sim::read_struct(root, "", "avoidance.parameters", config, faults);
  faults.throw_if_any();
}

/// As a MAVLink stream over TCP is read: in fragments, whose lengths come from the bytes themselves.
void read_mavlink(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  sim::mavlink::FrameDecoder pieces, whole;
  std::vector<uint32_t> ids;
  for (size_t at = 0; at < bytes.size();) {
    const size_t length = std::min<size_t>(1 + bytes[at] % 64, bytes.size() - at);
    for (const sim::mavlink::Frame& frame : pieces.decode(std::span(bytes).subspan(at, length)))
      ids.push_back(frame.id);
    at += length;
  }
  if (whole.decode(bytes).size() != ids.size()) throw std::logic_error("fragments change the frames");
  if (ids.empty()) throw std::invalid_argument("no frame");
}

/// The packets of an autopilot as they arrive in flight, from the format of a recording.
void read_packets(const std::filesystem::path& file) {
  sim::Scenario scenario;
  scenario.vehicle = dynamics::multicopter::MulticopterConfig{};
  scenario.physics_rate_hz = 1000;
  scenario.link = sim::ArduPilotLinkConfig{.multicopter = {.frame_class = 1, .frame_type = 0}};
  sim::link::ArduPilotLink link(scenario, std::make_unique<sim::link::ReplaySource>(file));
  sim::OutsideInput input;
  while (std::holds_alternative<sim::OutsideCommand>(link.exchange(input))) ++input.step;
}

constexpr std::array kReaders = {
    Reader{"scenario", "yaml", read_scenario},
    Reader{"sweep", "yaml", [](const std::filesystem::path& file) { sim::read_sweep(file); }},
    Reader{"campaign", "yaml", read_campaign},
    Reader{"plan", "yaml", [](const std::filesystem::path& file) { sim::read_registration(file); }},
    Reader{"earlier_batch", "json", read_earlier_batch},
    Reader{"falsify", "yaml", [](const std::filesystem::path& file) { sim::read_falsify(file); }},
    Reader{"vehicle", "yaml", [](const std::filesystem::path& file) { sim::load_vehicle(file); }},
    Reader{"paper", "yaml", [](const std::filesystem::path& file) { sim::read_paper(file); }},
    Reader{"parameters", "yaml", read_parameters},
    Reader{"mavlink", "bin", read_mavlink},
    Reader{"mesh_obj", "obj", read_mesh},
    Reader{"mesh_mtl", "mtl", read_materials},
    Reader{"mesh_gltf", "gltf", read_mesh},
    Reader{"mesh_dae", "dae", read_mesh},
    Reader{"mesh_ply", "ply", read_mesh},
    Reader{"mesh_stl", "stl", read_mesh},
    Reader{"mesh_sdf", "sdf", read_mesh},
    Reader{"heightmap", "image", [](const std::filesystem::path& file) { scenes::terrain::read_heightmap(file); }},
    Reader{"texture", "image", read_texture},
    Reader{"calibration", "txt", read_calibration},
    Reader{"result", "json", [](const std::filesystem::path& file) { sim::read_result(file); }},
    Reader{"columns", "csv", [](const std::filesystem::path& file) { sim::read_columns(file); }},
    Reader{"packets", "bin", read_packets},
    Reader{"pose_table", "csv", [](const std::filesystem::path& file) { scenes::read_pose_table(file); }},
    Reader{"reference", "csv", [](const std::filesystem::path& file) { sim::read_reference_path(file); }},
};

/// A folder for one process.
class Folder {
 public:
  Folder() {
    std::filesystem::create_directory(temporary_.path() / "in");
    for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs")) {
      std::filesystem::create_symlink(entry.path(), temporary_.path() / entry.path().filename());
    }
  }

  std::filesystem::path file(std::string_view extension) const {
    return temporary_.path() / "in" / ("input." + std::string(extension));
  }

 private:
  sim::TemporaryFolder temporary_;
};

}  // namespace

std::span<const Reader> readers() { return kReaders; }

const Reader* find(std::string_view name) {
  const auto* const found = std::ranges::find(kReaders, name, &Reader::name);
  return found == kReaders.end() ? nullptr : found;
}

bool feed(const Reader& reader, std::string_view bytes) {
  static const Folder folder;
  const std::filesystem::path file = folder.file(reader.extension);
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  try {
    reader.read(file);
    return true;
  } catch (const std::invalid_argument& fault) {
    if (typeid(fault) != typeid(std::invalid_argument) && typeid(fault) != typeid(fields::InvalidField)) throw;
  } catch (const std::runtime_error& fault) {
    // Not those of the standard library (std::range_error, a filesystem's) or of a package: they name no place.
    if (typeid(fault) != typeid(std::runtime_error) && typeid(fault) != typeid(sim::InputError)) throw;
  }
  return false;
}

}  // namespace hedgehop::fuzz

#include "sim/scenario/inputs.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <variant>

#include "scenes/mesh/mesh_import.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

/// Returns the path relative to the folder, or absolute if their common parent is too far up.
std::string name_of(const fs::path& file, const fs::path& folder) {
  constexpr auto kMaxUps = 3;  // folders up: a world of configs/leaderboard/worlds names a rig of configs/rigs
  const fs::path whole = fs::absolute(file).lexically_normal(), from = fs::absolute(folder / ".").lexically_normal();
  const fs::path relative = whole.lexically_relative(from);
  const auto ups = std::ranges::count(relative, fs::path(".."));
  const auto depth = std::ranges::count_if(from, [](const fs::path& part) { return !part.empty() && part != "/"; });
  return relative.empty() || ups > kMaxUps || ups >= depth ? whole.string() : relative.string();
}

std::set<fs::path> named_files(const Scenario& scenario) {
  std::set<fs::path> files;
  const scenes::SceneAdditions& added = std::visit(
      [](const auto& chosen) -> const auto& { return chosen.added; }, scenario.scene);
  if (added.terrain) files.insert(added.terrain->heightmap);
  const auto add_motion = [&files](const scenes::Motion& motion) {
    if (const auto* const table = std::get_if<scenes::TableMotion>(&motion)) files.insert(table->file);
  };
  for (const scenes::MoverConfig& mover : added.movers) add_motion(mover.motion);
  if (const auto* const balloon = std::get_if<scenes::worlds::BalloonConfig>(&scenario.scene))
    add_motion(balloon->motion);
  if (const auto* map = std::get_if<scenes::worlds::MapConfig>(&scenario.scene))
    files.merge(std::set<fs::path>{map->osm, map->terrain});
  for (const scenes::mesh::ImportConfig& import : added.imports) files.merge(scenes::mesh::mesh_files(import.file));
  for (const CameraConfig& camera : scenario.rig.cameras) files.insert(camera.calibration);
  files.insert(scenario.rig.read_calibrations.begin(), scenario.rig.read_calibrations.end());
  for (const CheckConfig& check : scenario.checks) {
    if (const auto* path = std::get_if<PathToleranceCheck>(&check)) files.insert(path->reference);
  }
  if (scenario.link) {
    for (const std::string& word : start_of(*scenario.link).command) {
      std::error_code ignored;
      if (fs::is_regular_file(word, ignored)) files.insert(word);
    }
  }
  const auto add_module = [&files](const AvoidanceConfig& config) {
    if (const PluginConfig* plugin = config.plugin()) files.insert(plugin->plugin);
    if (const PythonConfig* script = config.python()) files.insert(script->python);
  };
  add_module(scenario.avoidance);
  if (scenario.takeover) add_module(scenario.takeover->avoidance);
  files.erase(fs::path());
  return files;
}

std::string digest_of(std::istream& stream) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
  std::array<char, 65536> buffer{};
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    EVP_DigestUpdate(context.get(), buffer.data(), static_cast<size_t>(stream.gcount()));
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  EVP_DigestFinal_ex(context.get(), digest.data(), &length);
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace

Inputs inputs_of(const Scenario& scenario, const std::set<fs::path>& read, const fs::path& folder) {
  Inputs inputs;
  for (const auto& files : {read, named_files(scenario)}) {
    for (const fs::path& file : files) inputs[name_of(file, folder)] = sha256(file);
  }
  return inputs;
}

std::string scenario_sha256(Scenario scenario, const fs::path& folder) {
  scenario.seed = 0;
  scenario.description.clear();
  scenario.tags.clear();
  scenario.notes.clear();
  scenario.origin.reset();
  scenario.film = FilmConfig();
  std::string text = to_yaml(scenario), files;
  for (const fs::path& file : named_files(scenario)) {
    const std::string name = name_of(file, folder), whole = fs::absolute(file).lexically_normal().string();
    for (size_t at = 0; (at = text.find(whole, at)) != std::string::npos; at += name.size()) {
      text.replace(at, whole.size(), name);
    }
    files += name + " " + sha256(file) + "\n";
  }
  std::istringstream stream(text + files);
  return digest_of(stream);
}

std::string sha256(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return "missing";  // a pipe would wait for its writer
  std::ifstream stream(file, std::ios::binary);
  return stream ? digest_of(stream) : "missing";
}

}  // namespace hedgehop::sim

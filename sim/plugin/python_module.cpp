#include "sim/plugin/foreign_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/plugin/module_process.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

PythonMaker& known_maker() {
  static PythonMaker maker;
  return maker;
}

[[noreturn]] void refuse(const PythonConfig& config, const std::string& why) {
  throw InputError(FieldError{"avoidance.python", fmt::format("{}: {}", config.python.string(), why)});
}

/// Converts a scalar as in YAML's core schema.
nlohmann::json scalar(const Node& node) {
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  if (const auto whole = parse_signed(node.text)) return *whole;
  const ParsedNumber number = parse_number(node.text, /*degrees=*/false);
  if (number.kind == ParsedNumber::Kind::number) return number.member;
  return node.text;
}

nlohmann::json to_json(const Node& node) {
  nlohmann::json json;
  switch (node.kind) {
    case Node::Kind::null:
      return json;
    case Node::Kind::scalar:
      return scalar(node);
    case Node::Kind::list:
      json = nlohmann::json::array();
      for (const Node& item : node.items) json.push_back(to_json(item));
      return json;
    case Node::Kind::map:
      json = nlohmann::json::object();
      for (const Entry& entry : node.entries) json[entry.key] = to_json(entry.value);
      return json;
  }
  throw std::logic_error("unknown kind of node");
}

/// Returns the interpreter's library in the Python package: of a wheel, of the build folder, or of an installation.
std::optional<fs::path> interpreter_library() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> packages = {program / "..", program / "../../python/hedgehop"};
  for (const fs::directory_entry& folder : fs::directory_iterator(program / "../lib", error)) {
    if (!folder.path().filename().string().starts_with("python3")) continue;
    for (const char* const packages_of : {"dist-packages", "site-packages"})
      packages.push_back(folder.path() / packages_of / "hedgehop");
  }
  std::ranges::sort(packages.begin() + 2, packages.end());
  for (const fs::path& package : packages) {
    const fs::path library = (package / "libhedgehop_python.so").lexically_normal();
    if (fs::exists(library, error)) return library;
  }
  return std::nullopt;
}

PythonMaker load_maker(const PythonConfig& config) {
  const std::optional<fs::path> library = interpreter_library();
  if (!library) {
    refuse(config,
           "this program has no Python; install the package python3-hedgehop, or build with python3-dev and "
           "pybind11-dev, for a Python that has a shared library");
  }
  // Python's own extensions look its symbols up globally.
  void* const handle = ::dlopen(library->c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!handle) refuse(config, fmt::format("{} cannot be loaded: {}", library->string(), ::dlerror()));
  using Make = avoidance::Module*(const PythonRequest&);
  auto* const make = reinterpret_cast<Make*>(::dlsym(handle, "hedgehop_make_python_module"));
  if (!make) refuse(config, library->string() + " is not from this build");
  return [make](const PythonRequest& request) { return std::unique_ptr<avoidance::Module>(make(request)); };
}

}  // namespace

void set_python_maker(PythonMaker maker) { known_maker() = std::move(maker); }

std::unique_ptr<avoidance::Module> make_python_module(const PythonConfig& config, const fs::path& folder) {
  if (config.parameters.kind != Node::Kind::null && config.parameters.kind != Node::Kind::map) {
    refuse(config, "'parameters' must be a map, got " + config.parameters.description());
  }
  const std::string parameters =
      config.parameters.kind == Node::Kind::map ? to_json(config.parameters).dump() : std::string("{}");
  const PythonRequest request{fs::absolute(config.python).string(), config.class_name, parameters};
  const auto make = [&] {
    if (!known_maker()) set_python_maker(load_maker(config));
    auto module = known_maker()(request);
    // Validate its needs and signals before the flight.
    static_cast<void>(module->needs());
    static_cast<void>(module->signals());
    return module;
  };
  try {
    if (config.in_process || known_maker()) return make();
    return make_module_process(make, {.name = config.class_name, .limit_s = config.limit_s, .folder = folder});
  } catch (const InputError&) {
    throw;
  } catch (const ModuleFault&) {
    throw;
  } catch (const std::system_error&) {  // of the machine
    throw;
  } catch (const std::exception& fault) {
    refuse(config, fault.what());
  }
}

}  // namespace hedgehop::sim

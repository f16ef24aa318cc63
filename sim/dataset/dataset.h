#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/dataset/random_poses.h"

namespace hedgehop::sim {

enum class DatasetChannel { grey, color, depth, flow, semantic, instance };
/// Returns the channel of a name, such as "color". Throws InputError with the valid names.
DatasetChannel dataset_channel(const std::string& name);

/// A data set of images along poses, without flights. A world is a scenario with one of the seeds; the worlds are
/// numbered seed by seed within each scenario.
struct DatasetRequest {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> overrides;
  std::vector<uint64_t> seeds;
  std::filesystem::path poses;  ///< a file for parse_poses(); empty: random poses within `bounds`
  bool poses_of_camera = false;
  std::string camera;  ///< role; empty: the first camera of the rig with images
  size_t images = 0;   ///< in all worlds together, spread evenly; 0: every pose of the file in every world
  std::vector<DatasetChannel> channels;
  PoseBounds bounds;
  std::filesystem::path out;
};

/// The part of a world in training.
enum class Split { train, val, test };

/// Returns the part of each of `worlds` worlds: a tenth each for validation and test, rounded, and at least one each of
/// three or more; a shuffle that depends on the number of worlds alone.
std::vector<Split> splits_of(size_t worlds);

size_t world_count(const DatasetRequest& request);
std::string world_name(const DatasetRequest& request, size_t world);

/// Prepares the folder: it must be empty, or hold an unfinished data set of the same request, files and build if
/// `resume`. Throws InputError otherwise, as parse_poses(), and for a request without channels or images or with more
/// images than poses in the file; the folder is then not changed.
void begin_dataset(const DatasetRequest& request, bool resume);

/// Empties the folder again if no world is complete, so that a corrected request can begin.
void abandon_dataset(const DatasetRequest& request);

/// Whether a world is complete.
bool is_written(const DatasetRequest& request, size_t world);

/// Writes the images of a world: <split>/<channel>/NNNNNN.png (depth: .tiff, 32-bit floats, m), numbered through all
/// worlds, and labels/<scenario>-seed<N>.json. At the end, its rows of the manifest and of the COCO file appear in
/// worlds/. The scene is made once. Equal requests give equal files. Throws InputError as load_flight() and
/// parse_poses(), and for a world without free poses; std::runtime_error for a file that cannot be written.
void write_world(const DatasetRequest& request, size_t world);

/// Joins the worlds: manifest.csv, calibration/<scenario>.yaml and, with the channel instance, coco_<split>.json.
void finish_dataset(const DatasetRequest& request);

}  // namespace hedgehop::sim

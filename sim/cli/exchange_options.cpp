#include <CLI/CLI.hpp>
#include <functional>

#include "sim/cli/campaign_options.h"
#include "sim/cli/commands.h"

namespace hedgehop::sim::cli {

void declare_import(CLI::App& app, std::function<int()>& chosen, ImportOptions& field) {
  CLI::App* const command = app.add_subcommand(
      "import", "write an obstacle field of another program as a scene, for `scene: {use: FILE.yaml}`");
  command
      ->add_option(
          "FORMAT", field.format,
          "aerialist (tests of the UAV testing competition, YAML), sdf (worlds of SDFormat) or flightmare (CSV "
          "of static boxes, YAML of boxes that move by CSV)")
      ->required()
      ->check(CLI::IsMember({"aerialist", "sdf", "flightmare"}));
  command->add_option("FILES", field.files, "files of the field; their obstacles are added up")->required();
  command->add_option("--scale", field.scale, "meters per unit of an SDF file; default 1")
      ->transform(number())
      ->check(positive())
      ->type_name("M");
  command->add_option("-o", field.out, "output file; default standard output")->type_name("FILE.yaml");
  command
      ->add_option("--solids", field.solids,
                   "also write the pose and size of each obstacle, for a comparison with another reader")
      ->type_name("FILE.csv");
  command->add_option("--time", field.time_s, "time of the moving obstacles in this table, s; default 0")
      ->transform(number())
      ->check(not_negative())
      ->type_name("S");
  command->callback([&] { chosen = [&field] { return import_field(field); }; });
}

void declare_export(CLI::App& app, std::function<int()>& chosen, ExportOptions& data) {
  CLI::App* const command =
      app.add_subcommand("export", "re-simulate a run and write a data set or a log for other programs");
  command->add_option("RUN", data.source, "output folder of `hedgehop run`, or a scenario file (YAML), which is flown")
      ->required();
  command
      ->add_option("--format", data.format,
                   "data sets: euroc (mav0 with all cameras), tum (RGB-D of one pinhole camera with true depth), kitti "
                   "(odometry with pinhole cameras of one rate); logs: mcap (Foxglove, PlotJuggler), rosbag2 (ROS 2), "
                   "ulog (PX4's plots, without images)")
      ->required()
      ->check(CLI::IsMember({"euroc", "tum", "kitti", "mcap", "rosbag2", "ulog"}));
  command
      ->add_option("--camera", data.cameras,
                   "role of a camera to export; may be repeated, the first is cam0; default all cameras with images")
      ->type_name("NAME");
  CLI::Option* const truth = command->add_flag(
      "--truth", data.truth,
      "also write ground truth: for data sets depth, labels, classes, moving-object masks and optical flow; for mcap "
      "and rosbag2 depth");
  command
      ->add_flag("--float-depth", data.float_depth,
                 "ground-truth depth of a data set as TIFF of 32-bit floats, m, without a limit")
      ->needs(truth);
  command->add_option("--compression", data.compression, "of mcap and rosbag2: zstd (the default), lz4 or none")
      ->check(CLI::IsMember({"zstd", "lz4", "none"}));
  command->add_flag("--compressed-images", data.compressed_images,
                    "in rosbag2, images as PNG (CompressedImage) instead of Image");
  command
      ->add_option(
          "--out", data.out,
          "output folder, which must not exist, or must be empty; default <format> in the folder of the run, or "
          "out/<name>-seed<seed>/<format>")
      ->type_name("DIR");
  command->callback([&] { chosen = [&data] { return cli::export_run(data); }; });
}

}  // namespace hedgehop::sim::cli

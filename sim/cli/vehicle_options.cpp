#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "sim/cli/campaign_options.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_commands.h"

namespace hedgehop::sim::cli {
namespace {

void add_formats(CLI::App& command, bool& json, bool& csv) {
  CLI::Option* const as_json = command.add_flag("--json", json, "print JSON instead of a table");
  command.add_flag("--csv", csv, "print comma-separated values")->excludes(as_json);
}

void add_vehicle(CLI::App& command, std::filesystem::path& vehicle) {
  command.add_option("VEHICLE", vehicle, "vehicle file (YAML)")->required();
}

void add_airspeed(CLI::App& command, double& speed_mps) {
  command.add_option("--speed", speed_mps, "airspeed, m/s; default 0")->transform(number())->type_name("V");
}

CLI::Option* add_input(CLI::App& command, std::string& input) {
  return command
      .add_option("--input", input,
                  "control: collective, lateral, longitudinal or tail; of a multicopter thrust, roll, pitch or yaw")
      ->type_name("NAME");
}

CLI::Option* add_positive(CLI::App& command, const std::string& name, double& value, const std::string& meaning) {
  return command.add_option(name, value, meaning)->transform(number())->check(positive());
}

void declare_trim(CLI::App& app, std::function<int()>& chosen, VehicleOptions& vehicles) {
  CLI::App* const command = app.add_subcommand(
      "trim", "print or plot a vehicle's trim in level flight against airspeed, with margins to the control stops");
  add_vehicle(*command, vehicles.trim.vehicle);
  command->add_option("--speed", vehicles.speeds, "airspeed, or a range FROM:TO:STEP, m/s; default 0")
      ->type_name("RANGE");
  add_formats(*command, vehicles.trim.json, vehicles.trim.csv);
  command->add_option("--plot", vehicles.trim.plot, "also write a page with plots of the trim against airspeed")
      ->check(written_as(".html"))
      ->type_name("FILE.html");
  command->callback([&] {
    chosen = [&vehicles] {
      vehicles.trim.speeds_mps = speed_range(vehicles.speeds);
      return trim(vehicles.trim);
    };
  });
}

void declare_linearize(CLI::App& app, std::function<int()>& chosen, LinearizeOptions& options) {
  CLI::App* const command = app.add_subcommand(
      "linearize",
      "print a vehicle's linear model in level flight: A and B with units, and modes with name, frequency, damping and "
      "eigenvector");
  add_vehicle(*command, options.vehicle);
  add_airspeed(*command, options.speed_mps);
  add_formats(*command, options.json, options.csv);
  command->callback([&] { chosen = [&options] { return linearize(options); }; });
}

void declare_step(CLI::App& app, std::function<int()>& chosen, StepOptions& options) {
  CLI::App* const command = app.add_subcommand(
      "step",
      "print or plot a vehicle's response to a step or doublet of one control, next to that of its linear model");
  add_vehicle(*command, options.vehicle);
  add_input(*command, options.input)->required();
  command
      ->add_option("--size", options.size, "deviation from the trim with its unit, such as 1deg, 0.02rad, 0.5N, 0.01Nm")
      ->required()
      ->type_name("SIZE");
  command->add_option("--shape", options.shape, "step (the default) or doublet")
      ->check(CLI::IsMember({"step", "doublet"}));
  add_positive(*command, "--width", options.width_s, "duration of each half of a doublet, s; default 0.5")
      ->type_name("S");
  add_airspeed(*command, options.speed_mps);
  add_positive(*command, "--duration", options.duration_s, "duration, s; the input begins at 0.5 s; default 2")
      ->check(CLI::Range(1.0, 600.0))
      ->type_name("S");
  add_formats(*command, options.json, options.csv);
  command->add_option("--plot", options.plot, "also write a page with plots over time")
      ->check(written_as(".html"))
      ->type_name("FILE.html");
  command->callback([&] { chosen = [&options] { return step(options); }; });
}

void declare_identify(CLI::App& app, std::function<int()>& chosen, VehicleOptions& vehicles) {
  IdentifyOptions& options = vehicles.identify;
  CLI::App* const command = app.add_subcommand("identify",
                                               "identify a vehicle's frequency response from simulated sweeps "
                                               "(--input), or fit its parameters to recorded flights "
                                               "(--log)");
  add_vehicle(*command, options.vehicle);
  CLI::Option* const input = add_input(*command, options.input);
  add_log_fit(*command, vehicles.identify_log);
  command->get_option("--log")->excludes(input);
  command->add_option("--output", options.output, "state, such as p; default the main one of the control")
      ->type_name("STATE");
  command
      ->add_option("--size", options.size,
                   "amplitude of the sweep with its unit; default 0.2deg, or 2 % of a multicopter's maximum")
      ->type_name("SIZE");
  add_positive(*command, "--from", options.from_radps, "lowest frequency, rad/s; default 0.3")->type_name("W");
  add_positive(*command, "--to", options.to_radps, "highest frequency, rad/s; default 30")
      ->check(CLI::Range(0.0, 100.0))
      ->type_name("W");
  add_positive(*command, "--duration", options.duration_s, "duration of each sweep, s; default 105")
      ->check(CLI::Range(1.0, 3600.0))
      ->type_name("S");
  add_airspeed(*command, options.speed_mps);
  add_formats(*command, options.json, options.csv);
  command->add_option("--plot", options.plot, "also write a page with gain, phase and coherence")
      ->check(written_as(".html"))
      ->type_name("FILE.html");
  for (const char* simulated : {"--output", "--size", "--from", "--to", "--duration", "--speed", "--csv", "--plot"}) {
    command->get_option("--log")->excludes(command->get_option(simulated));
  }
  command->callback([&] {
    chosen = [&vehicles] {
      if (vehicles.identify_log.logs.empty()) return identify(vehicles.identify);
      vehicles.identify_log.vehicle = vehicles.identify.vehicle;
      vehicles.identify_log.json = vehicles.identify.json;
      return identify_log(vehicles.identify_log);
    };
  });
}

}  // namespace

void declare_vehicle_commands(CLI::App& app, std::function<int()>& chosen, VehicleOptions& vehicles) {
  declare_trim(app, chosen, vehicles);
  declare_linearize(app, chosen, vehicles.linearize);
  declare_step(app, chosen, vehicles.step);
  declare_identify(app, chosen, vehicles);
  declare_compare_log(app, chosen, vehicles.compare_log);
}

}  // namespace hedgehop::sim::cli

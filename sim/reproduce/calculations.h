#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// Columns of numbers, each with a name, of equal length.
using Columns = std::map<std::string, std::vector<double>>;

/// A figure of a paper that needs no flight: a measured cost, a closed loop of a point mass.
struct Calculation {
  std::string_view name, meaning;
  std::vector<std::string> columns;  ///< of its result
  Columns (*calculate)();            ///< seconds at most
};

/// All of them, each from a file of its own.
const std::vector<Calculation>& calculations();

/// The one of that name, or none.
const Calculation* find_calculation(std::string_view name);
std::vector<std::string_view> calculation_names();

/// Measures a choice among 3 x 3 to 27 x 27 sections of a 1280 x 720 depth map: `sections` in total, `decisions_hz`,
/// `cost_ms` (medians, wall time) and `cost_over_3x3`, measured alternately. Source: [Perez2018] table 1.
Columns section_costs();

/// Measures the filter time per image for several numbers of landmarks: `landmarks` (8 to 1,000), `image_ms` (median
/// over images, wall time), `speed` (at 10 Hz, as a multiple of real time), and `growth_8_to_35`, equal in every row.
/// The lateral flight of [Shah2009] ch. 4 past random corners, all of them in the image. Source: [Shah2009] ch. 6, sec.
/// on computational effort.
Columns landmark_costs();

/// Simulates a point mass in a straight corridor of 4 m with the published controller and an exact signal. It starts
/// 1.5 m left of the middle. Columns: `x_m` along the corridor and `off_middle_m` to the right of its middle, every 0.5
/// s for two minutes; `settled_m`, the distance after which it remains within 0.2 m of the middle, equal in every row.
/// Source: [Zingg2010] fig. 11. Differs: the speed, which is not published, is 0.42 m/s.
Columns centering_exact();

/// The same with normal signal errors that match the mean and maximum error of [Zingg2010] fig. 9; seed 1.
/// Source: [Zingg2010] fig. 12.
Columns centering_noisy();

}  // namespace hedgehop::sim

#include "sim/export/lens_model.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kPlumbBob = 5, kRational = 8, kFisheye = 4;  // coefficients

}  // namespace

std::optional<LensModel> lens_model(const LoggedCamera& camera, std::string_view fisheye) {
  using Model = Intrinsics::Model;
  if (!camera.lens) return std::nullopt;
  const Intrinsics& lens = *camera.lens;
  if (lens.model != Model::pinhole && lens.model != Model::fisheye) return std::nullopt;
  LensModel out{.model = fisheye, .D = lens.distortion};
  if (lens.model == Model::fisheye) {
    out.D.resize(kFisheye);
  } else {
    const bool rational = lens.distortion.size() > kPlumbBob;
    out.model = rational ? "rational_polynomial" : "plumb_bob";
    out.D.resize(rational ? kRational : kPlumbBob);
  }
  const double fx = lens.focal_x_px, fy = lens.focal_y_px, u = lens.center_u_px, v = lens.center_v_px;
  out.K = {fx, 0, u, 0, fy, v, 0, 0, 1};
  out.P = {fx, 0, u, -fx * camera.pair_baseline_m, 0, fy, v, 0, 0, 0, 1, 0};
  return out;
}

}  // namespace hedgehop::sim

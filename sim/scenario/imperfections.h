#pragma once

namespace hedgehop::sim {

/// What a real camera does to its images. All off by default. Numbers are per camera, drawn from its own stream. Those
/// of light, lens and sensor are for grey and color, disparity noise for depth, frame faults and readout for all.
struct ImperfectionsConfig {
  /// Of the stereo pair that a depth camera stands for: [Andert2007] sec. 2. It turns disparity noise into depth noise.
  static constexpr double kBaselineM = 0.3;

  double vignetting = 0.0;          ///< share of brightness missing in the corner
  double exposure_stops = 0.0;      ///< brighter (> 0) or darker than drawn, in powers of two
  double auto_exposure_s = 0.0;     ///< time constant that draws the mean to mid-grey; 0: off
  double full_well = 0.0;           ///< photo-electrons at white; 0: no photon noise
  double read_noise = 0.0;          ///< standard deviation, grey levels
  double fixed_pattern = 0.0;       ///< standard deviation of the pixels' gains, constant over a flight
  double disparity_noise_px = 0.0;  ///< standard deviation, of focal length times kBaselineM over depth
  double shutter_s = 0.0;           ///< how long the image is exposed
  int shutter_samples = 8;          ///< most moments that a blurred image is the mean of
  double readout_s = 0.0;           ///< from the first row's exposure to the last's; 0: global shutter
  int readout_strips = 16;          ///< of rows that share a moment
  double drop = 0.0;                ///< probability that an image is lost
  double freeze = 0.0;              ///< probability that the last image is delivered again
  double black = 0.0;               ///< probability that an image is black
};

template <class Visitor>
void describe(Visitor& v, ImperfectionsConfig& c) {
  v("vignetting", c.vignetting,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "share of the brightness that is missing in the image's corners"});
  v("exposure", c.exposure_stops,
    {.at_least = -10.0, .at_most = 10.0, .meaning = "stops by which images are brighter than drawn; white saturates"});
  v("auto_exposure", c.auto_exposure_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "time constant in which the mean is drawn to mid-grey; 0: fixed exposure"});
  v("full_well", c.full_well,
    {.at_least = 0.0, .meaning = "photo-electrons of a white pixel, whose count is noisy; 0: no photon noise"});
  v("read_noise", c.read_noise,
    {.at_least = 0.0,
     .at_most = 255.0,
     .meaning = "standard deviation of the noise of reading, in grey levels of 255"});
  v("fixed_pattern", c.fixed_pattern,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "standard deviation of the pixels' gains (photo-response nonuniformity), constant over a flight"});
  v("disparity_noise", c.disparity_noise_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "standard deviation of a depth camera's noise, as disparity of a pair with a baseline of 0.3 m"});
  v("shutter", c.shutter_s,
    {.unit = "s", .at_least = 0.0, .at_most = 1.0, .meaning = "how long an image is exposed, ending at its instant"});
  v("shutter_samples", c.shutter_samples,
    {.at_least = 1,
     .at_most = 256,
     .meaning = "most moments that an image with motion blur is the mean of; they lie at most 0.4 pixels apart where "
                "these are enough"});
  v("readout", c.readout_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 1.0,
     .meaning = "from the first row to the last, which is read at the "
                "image's instant; 0: global shutter"});
  v("readout_strips", c.readout_strips,
    {.at_least = 2, .at_most = 4096, .meaning = "strips of rows that a rolling shutter reads at one moment each"});
  v("drop", c.drop, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that an image is lost"});
  v("freeze", c.freeze,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that the last image comes again as a new one"});
  v("black", c.black, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that an image is black"});
}

}  // namespace hedgehop::sim

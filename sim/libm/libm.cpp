// Mathematical functions of programs linked with Hedgehop's libraries, with equal bits on every processor.
//
// The functions of the C library select instructions by processor; with fused multiply-add they round differently.
// These functions replace them by name and call SLEEF's variants without fused multiply-add. They are hidden, so shared
// libraries keep those of the C library. Sine and cosine both use the function for sine and cosine together, because
// the optimizer decides which of the three is called. fmod, remainder, round, ldexp and sqrt are exact in every C
// library and are not replaced.
#include <sleef.h>

// The names of the C library, without <cmath>, which would declare them.

namespace {
__m128d lane(double x) { return _mm_set_sd(x); }
double value(__m128d x) { return _mm_cvtsd_f64(x); }
__m128 lane(float x) { return _mm_set_ss(x); }
float value(__m128 x) { return _mm_cvtss_f32(x); }

// From here log(1 + x) is log(x); SLEEF's log1p returns infinity from 2.7e307.
constexpr double kLargeForLog1p = 1e17;
constexpr float kLargeForLog1pf = 1e9F;
}  // namespace

extern "C" {

double sin(double x) noexcept { return value(Sleef_cinz_sincosd2_u10sse2(lane(x)).x); }
double cos(double x) noexcept { return value(Sleef_cinz_sincosd2_u10sse2(lane(x)).y); }
void sincos(double x, double* sine, double* cosine) noexcept {
  const Sleef___m128d_2 both = Sleef_cinz_sincosd2_u10sse2(lane(x));
  *sine = value(both.x);
  *cosine = value(both.y);
}
double tan(double x) noexcept { return value(Sleef_cinz_tand2_u10sse2(lane(x))); }
double asin(double x) noexcept { return value(Sleef_cinz_asind2_u10sse2(lane(x))); }
double acos(double x) noexcept { return value(Sleef_cinz_acosd2_u10sse2(lane(x))); }
double atan(double x) noexcept { return value(Sleef_cinz_atand2_u10sse2(lane(x))); }
double atan2(double y, double x) noexcept { return value(Sleef_cinz_atan2d2_u10sse2(lane(y), lane(x))); }
double exp(double x) noexcept { return value(Sleef_cinz_expd2_u10sse2(lane(x))); }
double exp2(double x) noexcept { return value(Sleef_cinz_exp2d2_u10sse2(lane(x))); }
double expm1(double x) noexcept { return value(Sleef_cinz_expm1d2_u10sse2(lane(x))); }
double log(double x) noexcept { return value(Sleef_cinz_logd2_u10sse2(lane(x))); }
double log2(double x) noexcept { return value(Sleef_cinz_log2d2_u10sse2(lane(x))); }
double log10(double x) noexcept { return value(Sleef_cinz_log10d2_u10sse2(lane(x))); }
double log1p(double x) noexcept { return x > kLargeForLog1p ? log(x) : value(Sleef_cinz_log1pd2_u10sse2(lane(x))); }
double sinh(double x) noexcept { return value(Sleef_cinz_sinhd2_u10sse2(lane(x))); }
double cosh(double x) noexcept { return value(Sleef_cinz_coshd2_u10sse2(lane(x))); }
double tanh(double x) noexcept { return value(Sleef_cinz_tanhd2_u10sse2(lane(x))); }
double cbrt(double x) noexcept { return value(Sleef_cinz_cbrtd2_u10sse2(lane(x))); }
double hypot(double x, double y) noexcept { return value(Sleef_cinz_hypotd2_u05sse2(lane(x), lane(y))); }
__extension__ double cabs(double __complex__ z) noexcept { return hypot(__real__ z, __imag__ z); }
double pow(double x, double y) noexcept { return y == 1.0 ? x : value(Sleef_cinz_powd2_u10sse2(lane(x), lane(y))); }

float sinf(float x) noexcept { return value(Sleef_cinz_sincosf4_u10sse2(lane(x)).x); }
float cosf(float x) noexcept { return value(Sleef_cinz_sincosf4_u10sse2(lane(x)).y); }
void sincosf(float x, float* sine, float* cosine) noexcept {
  const Sleef___m128_2 both = Sleef_cinz_sincosf4_u10sse2(lane(x));
  *sine = value(both.x);
  *cosine = value(both.y);
}
float tanf(float x) noexcept { return value(Sleef_cinz_tanf4_u10sse2(lane(x))); }
float asinf(float x) noexcept { return value(Sleef_cinz_asinf4_u10sse2(lane(x))); }
float acosf(float x) noexcept { return value(Sleef_cinz_acosf4_u10sse2(lane(x))); }
float atanf(float x) noexcept { return value(Sleef_cinz_atanf4_u10sse2(lane(x))); }
float atan2f(float y, float x) noexcept { return value(Sleef_cinz_atan2f4_u10sse2(lane(y), lane(x))); }
float expf(float x) noexcept { return value(Sleef_cinz_expf4_u10sse2(lane(x))); }
float exp2f(float x) noexcept { return value(Sleef_cinz_exp2f4_u10sse2(lane(x))); }
float expm1f(float x) noexcept { return value(Sleef_cinz_expm1f4_u10sse2(lane(x))); }
float logf(float x) noexcept { return value(Sleef_cinz_logf4_u10sse2(lane(x))); }
float log2f(float x) noexcept { return value(Sleef_cinz_log2f4_u10sse2(lane(x))); }
float log10f(float x) noexcept { return value(Sleef_cinz_log10f4_u10sse2(lane(x))); }
float log1pf(float x) noexcept { return x > kLargeForLog1pf ? logf(x) : value(Sleef_cinz_log1pf4_u10sse2(lane(x))); }
float sinhf(float x) noexcept { return value(Sleef_cinz_sinhf4_u10sse2(lane(x))); }
float coshf(float x) noexcept { return value(Sleef_cinz_coshf4_u10sse2(lane(x))); }
float tanhf(float x) noexcept { return value(Sleef_cinz_tanhf4_u10sse2(lane(x))); }
float cbrtf(float x) noexcept { return value(Sleef_cinz_cbrtf4_u10sse2(lane(x))); }
float hypotf(float x, float y) noexcept { return value(Sleef_cinz_hypotf4_u05sse2(lane(x), lane(y))); }
float powf(float x, float y) noexcept { return y == 1.0F ? x : value(Sleef_cinz_powf4_u10sse2(lane(x), lane(y))); }

}  // extern "C"

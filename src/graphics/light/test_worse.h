// The worse of two errors.
#pragma once

namespace parvis::light {

/// The larger; NaN where either is NaN, so that nothing that is no number passes.
inline double worse(double a, double b) { return a >= b ? a : (b > a ? b : a + b); }

}  // namespace parvis::light

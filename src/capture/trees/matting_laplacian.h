// Alpha by the matting Laplacian (Levin, Lischinski and Weiss 2008, A Closed-Form Solution to Natural Image
// Matting): within each 3x3 window alpha is an affine function of colour, so that it flows from the zones
// that are known to what looks alike beside them.
//
// Departure: information-flow matting (Aksoy and others 2017) adds flows between distant pixels; OpenCV's
// module for it is no part of the packages that Parvis is built with.
#pragma once

#include <vector>

#include "capture/trees/matte.h"

namespace parvis::trees {

/// Alpha of each pixel, 0..1, row by row: 0 and 1 in the zones. Solved by conjugate gradients, which starts
/// from `start` (one value per pixel).
std::vector<float> laplacian_alpha(const Image8& photograph, const Zones& zones, std::vector<float> start);

}  // namespace parvis::trees

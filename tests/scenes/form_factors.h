#pragma once

namespace relamp::scenes
{

// Configuration factors between finite surfaces: the share of what one sends that the other
// receives, and of the first one's view that the second fills, over the first one's area. The
// formulas are those of J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
// 3rd ed.; lengths in m.

/// Between two rectangles a x b that lie opposite to each other at a distance (C-11).
double opposite(double a, double b, double distance);

/// From a rectangle of one width to one of another that stands on it at a right angle, along an
/// edge that both have (C-14).
double adjacent(double edge, double widthOfFrom, double widthOfTo);

} // namespace relamp::scenes

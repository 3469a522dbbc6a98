#include "scenes/form_factors.h"

#include <cmath>
#include <numbers>

namespace relamp::scenes
{

double opposite(double a, double b, double distance)
{
    const double x = a / distance;
    const double y = b / distance;
    const double xx = 1.0 + x * x;
    const double yy = 1.0 + y * y;
    return 2.0 / (std::numbers::pi * x * y) *
           (0.5 * std::log(xx * yy / (xx + yy - 1.0)) +
            x * std::sqrt(yy) * std::atan(x / std::sqrt(yy)) +
            y * std::sqrt(xx) * std::atan(y / std::sqrt(xx)) - x * std::atan(x) - y * std::atan(y));
}

double adjacent(double edge, double widthOfFrom, double widthOfTo)
{
    const double ww = widthOfFrom * widthOfFrom / (edge * edge);
    const double hh = widthOfTo * widthOfTo / (edge * edge);
    const double w = std::sqrt(ww);
    const double h = std::sqrt(hh);
    const double all = 1.0 + ww + hh;
    const double logs = std::log((1.0 + ww) * (1.0 + hh) / all) +
                        ww * std::log(ww * all / ((1.0 + ww) * (ww + hh))) +
                        hh * std::log(hh * all / ((1.0 + hh) * (ww + hh)));
    return (w * std::atan(1.0 / w) + h * std::atan(1.0 / h) -
            std::sqrt(ww + hh) * std::atan(1.0 / std::sqrt(ww + hh)) + 0.25 * logs) /
           (std::numbers::pi * w);
}

} // namespace relamp::scenes

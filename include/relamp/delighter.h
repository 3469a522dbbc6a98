#pragma once

#include "relamp/api.h"
#include "relamp/delight.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <memory>

namespace relamp
{

/// Takes the light out of one scan again and again, as a person changes parameters: what they do
/// not change is not computed again.
///
/// Keeps beside what its results refer to (texels, the tree of rays, shadows), of the solver
/// gather: 4 bytes a ray, 8 bytes a lamp and side of a surfel, and some 200 bytes a surfel. Of
/// the solver thesis: 3 bytes a pixel. What another solver or quality needs otherwise goes.
///
/// To be used by one thread at a time; results may be used by others meanwhile, and outlive it.
class RELAMP_API Delighter
{
public:
    /// All results share the scan, which is not null.
    explicit Delighter(std::shared_ptr<const Scan> scan);
    /// Takes the scan over.
    explicit Delighter(Scan&& scan);
    ~Delighter();
    Delighter(Delighter&&) noexcept;
    Delighter& operator=(Delighter&&) noexcept;

    /// As delight(), to the bit. After an Error it can be used on.
    [[nodiscard]] Decomposition solve(const DelightOptions& options = {},
                                      Progress& progress = unwatched());

    /// Whether the last result of solve() is the solver gather's, so that it can be re-evaluated.
    [[nodiscard]] bool canReevaluate() const;

    /// The room as it would be had its lamps been as bright as `lights` say. These are the lights
    /// of the last result of solve(), with other radiances of the fixtures, irradiance of the sun
    /// and ambient light; all else of them is passed over. The very lights of that result give it
    /// again, to the bit, as long as the same engine computes: that of solve()'s options. CPU and
    /// GPU agree to 0.5 % but for one value in a thousand, to 2 % but for one in ten thousand.
    ///
    /// No ray is cast and nothing is fitted again: light that the mesh does not explain is taken
    /// off as before. A fixture of radiance 0 is no lamp: what is burnt out of it is wall. Beyond
    /// 96 burnt-out pieces alike neighbours are one lamp to the solver and get their mean.
    ///
    /// Throws Error(unsupported) unless canReevaluate(), Error(sizeMismatch) where these are other
    /// fixtures or a sun that is not there, Error(malformed) where a number is negative or none.
    [[nodiscard]] Decomposition reevaluate(const Lights& lights, const AlbedoOptions& albedo = {},
                                           Progress& progress = unwatched());

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace relamp

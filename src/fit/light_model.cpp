#include "fit/light_model.h"

#include "base/instruction_set.h"
#include "base/lanes.h"
#include "base/parallel.h"

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kSums = 8; // that do not wait for each other

struct LightArgs
{
    const LightModel* model;
    const double* radiance;
    double* irradiance;
    size_t first; // place of the first of these
    size_t begin;
    size_t end;
};

void lightKernel(const LightArgs& args)
{
    const size_t pieces = args.model->pieces;
    const size_t outsides = args.model->outsides;
    const double* outside = args.radiance + pieces;
    for (size_t i = args.begin; i < args.end; ++i) {
        const float* direct = args.model->direct.data() + (args.first + i) * pieces;
        const float* missed = args.model->missed.data() + (args.first + i) * outsides;
        double sums[kSums] = {};
        size_t f = 0;
        for (; f + kSums <= pieces; f += kSums) {
            RELAMP_KEEP_LOOP
            for (size_t k = 0; k < kSums; ++k)
                sums[k] += args.radiance[f + k] * static_cast<double>(direct[f + k]);
        }
        double sum = 0.0;
        for (; f < pieces; ++f) sum += args.radiance[f] * static_cast<double>(direct[f]);
        for (size_t o = 0; o < outsides; ++o) sum += outside[o] * static_cast<double>(missed[o]);
        for (const double part : sums) sum += part;
        args.irradiance[i] += sum;
    }
}

} // namespace

void addLight(const LightModel& model, std::span<const double> radiance, size_t first,
              std::span<double> irradiance)
{
    forEachChunk(irradiance.size(), 256, [&](size_t begin, size_t end) {
        const LightArgs args{&model, radiance.data(), irradiance.data(), first, begin, end};
        runKernel<lightKernel>(bestInstructionSet(), args);
    });
}

} // namespace relamp

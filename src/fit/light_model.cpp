#include "fit/light_model.h"

#include "base/instruction_set.h"
#include "base/lanes.h"
#include "base/parallel.h"

#include <algorithm>
#include <numeric>

namespace relamp
{
namespace
{

/// Places are in the order of a curve through space, so that the mean number of those that a piece
/// lights says where it is.
std::vector<uint32_t> orderOf(const LightModel& model)
{
    std::vector<double> sum(model.pieces, 0.0);
    std::vector<double> weighed(model.pieces, 0.0);
    for (size_t i = 0; i < model.places(); ++i)
        for (const auto [f, direct] : model.direct[i]) {
            sum[f] += static_cast<double>(direct);
            weighed[f] += static_cast<double>(direct) * static_cast<double>(i);
        }
    std::vector<double> mean(model.pieces, 0.0);
    for (size_t f = 0; f < model.pieces; ++f)
        if (sum[f] > 0.0) mean[f] = weighed[f] / sum[f];
    std::vector<uint32_t> order(model.pieces);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return mean[a] < mean[b]; });
    return order;
}

PackedRows rowsOf(const LightModel& model, std::span<const uint32_t> order)
{
    std::vector<uint32_t> columns(order.size());
    for (uint32_t k = 0; k < order.size(); ++k) columns[order[k]] = k;
    return {model.shown.size(), model.pieces + model.outsides, [&](size_t i, std::span<float> row) {
                for (const auto [f, direct] : model.direct[i]) row[columns[f]] = direct;
                for (const auto [part, missed] : model.missed[i]) row[model.pieces + part] = missed;
            }};
}

struct LightArgs
{
    const PackedRows* rows;
    const double* radiance; // in their columns, padded to lanes
    double* irradiance;
    size_t first; // place of the first of these
    size_t begin;
    size_t end;
};

void lightKernel(const LightArgs& args)
{
    for (size_t i = args.begin; i < args.end; ++i) {
        const PackedRows::Row row = args.rows->row(args.first + i);
        const float* values = row.values;
        double sums[kLanes] = {}; // that do not wait for each other
        for (const size_t group : row.groups) {
            const double* radiance = args.radiance + group * kLanes;
            RELAMP_KEEP_LOOP
            for (size_t lane = 0; lane < kLanes; ++lane)
                sums[lane] += radiance[lane] * static_cast<double>(values[lane]);
            values += kLanes;
        }
        double sum = 0.0;
        for (const double part : sums) sum += part;
        args.irradiance[i] += sum;
    }
}

} // namespace

PackedLight::PackedLight(const LightModel& model)
    : order(orderOf(model)), rows(rowsOf(model, order))
{}

void PackedLight::add(std::span<const double> radiance, size_t first,
                      std::span<double> irradiance) const
{
    std::vector<double> columns(paddedToLanes(rows.columns()), 0.0);
    for (size_t k = 0; k < order.size(); ++k) columns[k] = radiance[order[k]];
    for (size_t k = order.size(); k < rows.columns(); ++k) columns[k] = radiance[k];
    forEachChunk(irradiance.size(), 256, [&](size_t begin, size_t end) {
        const LightArgs args{&rows, columns.data(), irradiance.data(), first, begin, end};
        runKernel<lightKernel>(bestInstructionSet(), args);
    });
}

} // namespace relamp

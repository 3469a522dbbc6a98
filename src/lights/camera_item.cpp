#include "lights/camera_item.h"

#include "base/json.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relamp
{
namespace
{

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kLeastSlope = 0.1;
constexpr double kMostSlope = 10.0;
constexpr double kLeastExponent = 0.05; // of local tone mapping
constexpr double kMostStops = 12.0;     // of a gain, either way
constexpr std::int64_t kMostKnotsAlong = 1000;
constexpr size_t kMostKnotsOfFile = 100000;

std::vector<double> numbersIn(const JsonItem& item, const char* key, double low, double high)
{
    const json* list = item.find(key);
    if (list == nullptr || !list->is_array())
        item.refuse(fmt::format("needs \"{}\", a list of numbers", key), key);
    std::vector<double> numbers;
    for (const json& number : *list) {
        const double value = number.is_number() ? number.get<double>() : NAN;
        if (!(value >= low && value <= high))
            item.refuse(fmt::format("\"{}\" has {} in it; its numbers are {} to {}", key,
                                    printable(number), low, high),
                        key);
        numbers.push_back(value);
    }
    return numbers;
}

Response responseFrom(const JsonItem& item)
{
    const std::vector<double> slopes = numbersIn(item, "response", kLeastSlope, kMostSlope);
    Response response;
    if (slopes.size() != response.slope.size())
        item.refuse(fmt::format("\"response\" must be {} slopes", response.slope.size()),
                    "response");
    for (size_t k = 0; k < slopes.size(); ++k) response.slope[k] = static_cast<float>(slopes[k]);
    return response;
}

Gain gainFrom(const JsonItem& item)
{
    Gain gain{.origin = item.vectorAt("origin"),
              .spacing = static_cast<float>(item.numberAt("spacing", 1e-3, 1e6))};
    const std::vector<double> count =
        numbersIn(item, "count", 1.0, static_cast<double>(kMostKnotsAlong));
    if (count.size() != gain.count.size())
        item.refuse("\"count\" must be three numbers of knots", "count");
    size_t knots = 1;
    for (size_t axis = 0; axis < gain.count.size(); ++axis) {
        gain.count[axis] = static_cast<int>(count[axis]);
        knots *= static_cast<size_t>(gain.count[axis]);
    }
    const std::vector<double> stops = numbersIn(item, "stops", -kMostStops, kMostStops);
    const bool isColored = stops.size() == 3 * knots;
    if ((stops.size() != knots && !isColored) || knots > kMostKnotsOfFile)
        item.refuse(fmt::format("\"stops\" has {} numbers and \"count\" says {} knots, of one "
                                "number or three each",
                                stops.size(), knots),
                    "stops");
    for (size_t k = 0; k < knots; ++k) {
        glm::dvec3 stop(stops[isColored ? 3 * k : k]);
        if (isColored) stop = {stops[3 * k], stops[3 * k + 1], stops[3 * k + 2]};
        gain.log.emplace_back(stop * std::log(2.0));
    }
    return gain;
}

/// One, or of "rooms" one each.
std::vector<Gain> gainsFrom(const JsonItem& item, std::vector<std::string>& warnings)
{
    if (!item.has("rooms")) {
        item.warnOfUnknown({"origin", "spacing", "count", "stops", "drifted"}, warnings);
        return {gainFrom(item)};
    }
    item.warnOfUnknown({"rooms", "drifted"}, warnings);
    std::vector<Gain> gains;
    item.forEachIn("rooms", "room", [&](const JsonItem& room) {
        room.warnOfUnknown({"origin", "spacing", "count", "stops"}, warnings);
        gains.push_back(gainFrom(room));
    });
    return gains;
}

ordered_json gainAsJson(const Gain& gain)
{
    ordered_json stops = ordered_json::array();
    const bool isGrey = std::all_of(gain.log.begin(), gain.log.end(),
                                    [](glm::vec3 log) { return log == glm::vec3(log.g); });
    for (const glm::vec3 log : gain.log)
        for (int c = 0; c < (isGrey ? 1 : 3); ++c)
            stops.push_back(shortest(log[c] / std::log(2.0f)));
    return {{"origin", {shortest(gain.origin.x), shortest(gain.origin.y), shortest(gain.origin.z)}},
            {"spacing", shortest(gain.spacing)},
            {"count", gain.count},
            {"stops", std::move(stops)}};
}

} // namespace

ordered_json cameraAsJson(const CameraModel& camera)
{
    ordered_json object = ordered_json::object();
    if (!camera.response.isStraight())
        for (const float slope : camera.response.slope)
            object["response"].push_back(shortest(slope));
    if (!camera.tone.gain.isOne()) {
        object["localTone"] = {{"exponent", shortest(camera.tone.exponent)}};
        object["localTone"].update(gainAsJson(camera.tone.gain));
    }
    if (camera.gains.empty()) return object;
    ordered_json& gain = object["gain"];
    if (camera.gains.size() == 1)
        gain = gainAsJson(camera.gains.front());
    else
        for (const Gain& room : camera.gains) gain["rooms"].push_back(gainAsJson(room));
    gain["drifted"] = shortest(camera.drifted);
    return object;
}

CameraModel cameraOf(const JsonItem& item, std::vector<std::string>& warnings)
{
    CameraModel camera;
    item.warnOfUnknown({"response", "localTone", "gain"}, warnings);
    if (item.has("response")) camera.response = responseFrom(item);
    if (const std::optional<JsonItem> tone = item.objectIn("localTone")) {
        tone->warnOfUnknown({"exponent", "origin", "spacing", "count", "stops"}, warnings);
        camera.tone = {static_cast<float>(tone->numberAt("exponent", kLeastExponent, 1.0)),
                       gainFrom(*tone)};
    }
    if (const std::optional<JsonItem> gain = item.objectIn("gain")) {
        camera.gains = gainsFrom(*gain, warnings);
        camera.drifted = 1.0f; // in files that do not say, it was found so
        if (gain->has("drifted"))
            camera.drifted = static_cast<float>(gain->numberAt("drifted", 0.0, 1.0));
    }
    return camera;
}

} // namespace relamp

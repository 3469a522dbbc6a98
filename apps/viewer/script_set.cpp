#include "script_set.h"

#include "script.h"
#include "viewer.h"

#include "relamp/error.h"
#include "relamp/names.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace
{

using Words = std::vector<std::string>; // the name and its values

[[noreturn]] void wrongSetting(const std::string& sentence)
{
    throw relamp::Error(relamp::ErrorCode::malformed, sentence);
}

float number(const Words& words, size_t at = 1)
{
    if (at >= words.size()) wrongSetting(fmt::format("{} needs more numbers", words[0]));
    return numberOf(words[at]);
}

glm::vec3 vector(const Words& words, size_t at = 1)
{
    return {number(words, at), number(words, at + 1), number(words, at + 2)};
}

bool flag(const Words& words)
{
    if (words[1] == "on") return true;
    if (words[1] == "off") return false;
    wrongSetting(fmt::format("{} is on or off, not \"{}\"", words[0], words[1]));
}

template<size_t count>
size_t indexOf(const std::string& word, const std::array<const char*, count>& names)
{
    std::string known;
    for (size_t i = 0; i < count; ++i) {
        if (word == names[i]) return i;
        known += (i == 0 ? "" : ", ") + std::string(names[i]);
    }
    wrongSetting(fmt::format("\"{}\" is none of {}", word, known));
}

template<class Enum>
Enum valueOf(const std::string& word)
{
    return static_cast<Enum>(indexOf(word, relamp::Names<Enum>::all));
}

Layer layerNamed(const std::string& word)
{
    for (const LayerName& layer : kLayers)
        if (word == layer.name) return layer.layer;
    wrongSetting(fmt::format("\"{}\" is no layer", word));
}

glm::vec3 direction(const Words& words)
{
    const glm::vec3 way = vector(words);
    if (glm::length(way) < 1e-6f) wrongSetting("a direction has a length");
    return glm::normalize(way);
}

void setCamera(Viewer& viewer, const Words& words)
{
    const glm::vec3 position = vector(words);
    const glm::vec3 way = vector(words, 4) - position;
    const float distance = glm::length(way);
    if (distance < 1e-4f)
        wrongSetting("the camera must look at another place than where it stands");
    const float angle = words.size() > 7 ? glm::radians(number(words, 7)) : 1.3f;
    viewer.studio.camera.set({position, way / distance, {0, 1, 0}, angle}, distance);
    viewer.studio.isCameraUntouched = false;
}

template<class T>
void setNumber(T& parameter, const Words& words, float low, float high)
{
    parameter = static_cast<T>(std::clamp(number(words), low, high));
}

/// "auto" leaves it to the scan.
void setNumber(std::optional<float>& parameter, const Words& words, float low, float high)
{
    parameter.reset();
    if (words[1] != "auto") parameter = std::clamp(number(words), low, high);
}

/// The solvers' parameters, by the names and ranges that relamp delight has.
const std::map<std::string, std::function<void(SolverParameters&, const Words&)>>& parameters()
{
    using D = SolverParameters;
    using W = Words;
    static const std::map<std::string, std::function<void(D&, const W&)>> all{
        {"parameter.rays",
         [](D& d, const W& w) {
             d.gather.rays = 0;
             if (w[1] != "auto") setNumber(d.gather.rays, w, 4.0f, 1024.0f);
         }},
        {"parameter.shadow-rays",
         [](D& d, const W& w) {
             d.gather.shadowRays = 0;
             if (w[1] != "auto") setNumber(d.gather.shadowRays, w, 1.0f, 1024.0f);
         }},
        {"parameter.sun", [](D& d, const W& w) { d.gather.sun = flag(w); }},
        {"parameter.samples",
         [](D& d, const W& w) { setNumber(d.pathtrace.samples, w, 1.0f, 65536.0f); }},
        {"parameter.seed", [](D& d, const W& w) { d.pathtrace.seed = wholeNumberOf(w[1]); }},
        {"parameter.darkest",
         [](D& d, const W& w) { setNumber(d.albedo.darkest, w, 1e-6f, 1.0f); }},
        {"parameter.fill", [](D& d, const W& w) { d.albedo.fill = flag(w); }},
        {"parameter.emitter-threshold",
         [](D& d, const W& w) { setNumber(d.thesis.emitterThreshold, w, 0.0f, 1.0f); }},
        {"parameter.expansion",
         [](D& d, const W& w) { setNumber(d.thesis.expansion, w, 1.0f, 1e4f); }},
        {"parameter.light-levels",
         [](D& d, const W& w) { setNumber(d.thesis.lightLevels, w, 0.0f, 10.0f); }},
        {"parameter.attenuation",
         [](D& d, const W& w) {
             d.thesis.attenuation.reset();
             if (w[1] != "auto") d.thesis.attenuation = glm::max(vector(w), 0.0f);
         }},
        {"parameter.power", [](D& d, const W& w) { setNumber(d.thesis.power, w, 1e-6f, 1e6f); }},
        {"parameter.ambient", [](D& d, const W& w) { setNumber(d.thesis.ambient, w, 0.0f, 1e6f); }},
        {"parameter.merge-distance",
         [](D& d, const W& w) { setNumber(d.thesis.mergeDistance, w, 0.0f, 1e6f); }},
        {"parameter.rsm-size",
         [](D& d, const W& w) { setNumber(d.thesis.rsmSize, w, 8.0f, 512.0f); }},
        {"parameter.lpv-size",
         [](D& d, const W& w) { setNumber(d.thesis.lpvSize, w, 8.0f, 128.0f); }},
        {"parameter.lpv-steps",
         [](D& d, const W& w) { setNumber(d.thesis.lpvSteps, w, 1.0f, 128.0f); }},
        {"parameter.flatten-reach",
         [](D& d, const W& w) { setNumber(d.thesis.flattenReach, w, 1.0f, 2.0f); }},
        {"parameter.flatten-range",
         [](D& d, const W& w) { setNumber(d.thesis.flattenRange, w, 0.01f, 10.0f); }},
        {"parameter.lpv", [](D& d, const W& w) { d.thesis.useLpv = flag(w); }},
        {"parameter.ambient-light", [](D& d, const W& w) { d.thesis.useAmbient = flag(w); }}};
    return all;
}

/// What is set beside lights.
const std::map<std::string, std::function<void(Viewer&, const Words&)>>& settings()
{
    using V = Viewer;
    using W = Words;
    static const std::map<std::string, std::function<void(V&, const W&)>> all{
        {"layer", [](V& v, const W& w) { v.shown.layer = layerNamed(w[1]); }},
        {"before", [](V& v, const W& w) { v.shown.before = layerNamed(w[1]); }},
        {"compare",
         [](V& v, const W& w) {
             v.shown.compares = w[1] != "off";
             if (v.shown.compares) v.shown.slider = std::clamp(number(w), 0.0f, 1.0f);
         }},
        {"wireframe", [](V& v, const W& w) { v.shown.wireframe = flag(w); }},
        {"atlas", [](V& v, const W& w) { v.shown.atlas = flag(w); }},
        {"panels", [](V& v, const W& w) { v.shown.panels = flag(w); }},
        {"marks", [](V& v, const W& w) { v.shown.marks = flag(w); }},
        {"help", [](V& v, const W& w) { v.shown.help = flag(w); }},
        {"camera", setCamera},
        {"mode",
         [](V& v, const W& w) {
             constexpr std::array<const char*, 2> kModes{"orbit", "walk"};
             v.studio.camera.mode = static_cast<CameraRig::Mode>(indexOf(w[1], kModes));
         }},
        {"place", [](V& v, const W& w) { v.studio.place = vector(w); }},
        {"exposure", [](V& v, const W& w) { v.studio.edit.view.exposure = number(w); }},
        {"view", [](V& v, const W& w) { v.studio.edit.view.view = valueOf<relamp::View>(w[1]); }},
        {"solver",
         [](V& v, const W& w) { v.studio.edit.parameters.solver = valueOf<relamp::Solver>(w[1]); }},
        {"quality",
         [](V& v, const W& w) {
             v.studio.edit.parameters.gather.quality = valueOf<relamp::Quality>(w[1]);
         }},
        {"lights", [](V& v, const W& w) { v.studio.loadLights(w[1]); }},
        {"timeline", [](V& v, const W& w) { v.studio.loadTimeline(w[1]); }},
        {"time", [](V& v, const W& w) { v.studio.seek(std::clamp(number(w), 0.0f, 1.0f)); }},
        {"sky",
         [](V& v, const W& w) { v.studio.edit.light.sky.radiance = glm::max(vector(w), 0.0f); }},
        {"scanned.sun",
         [](V& v, const W& w) { v.studio.edit.scanned.sun = std::max(number(w), 0.0f); }},
        {"scanned.sun.colour",
         [](V& v, const W& w) { v.studio.edit.scanned.sunColour = glm::max(vector(w), 0.0f); }},
        {"scanned.ambient",
         [](V& v, const W& w) { v.studio.edit.scanned.ambient = glm::max(vector(w), 0.0f); }},
        {"select", [](V& v, const W& w) {
             constexpr std::array<const char*, 3> kKinds{"none", "lamp", "fixture"};
             v.select({static_cast<Selection::Kind>(indexOf(w[1], kKinds)),
                       w.size() > 2 ? static_cast<size_t>(number(w, 2)) : 0});
         }}};
    return all;
}

void setLamp(LampItem& lamp, const std::string& what, const Words& words)
{
    const std::map<std::string, std::function<void()>> all{
        {"type", [&] { lamp.type = lightTypeNamed(words[1]); }},
        {"position", [&] { lamp.position = vector(words); }},
        {"direction", [&] { lamp.direction = direction(words); }},
        {"size",
         [&] {
             lamp.size = {number(words), number(words, 2)};
         }},
        {"radius", [&] { lamp.radius = number(words); }},
        {"cone", [&] { lamp.cone = number(words); }},
        {"lumens",
         [&] {
             lamp.unit = "lumens";
             lamp.amount = number(words);
         }},
        {"kelvin",
         [&] {
             lamp.byKelvin = true;
             lamp.kelvin = number(words);
         }},
        {"colour",
         [&] {
             lamp.byKelvin = false;
             lamp.colour = vector(words);
         }},
        {"on", [&] { lamp.on = flag(words); }},
        {"dim", [&] { lamp.dim = number(words); }}};
    const auto found = all.find(what);
    if (found == all.end()) wrongSetting(fmt::format("a light has no \"{}\"", what));
    found->second();
}

void setFixture(FixtureItem& fixture, const std::string& what, const Words& words)
{
    if (what == "on")
        fixture.on = flag(words);
    else if (what == "dim")
        fixture.dim = number(words);
    else if (what == "kelvin")
        fixture.kelvin = number(words);
    else if (what == "lumens")
        fixture.lumens = number(words);
    else if (what == "window")
        fixture.window = flag(words);
    else
        wrongSetting(fmt::format("a fixture has no \"{}\"", what));
}

/// "lamp.0.lumens" and the like: of lights as they shine now, and of fixtures as they were
/// "scanned". False where the name is another.
bool setLight(Viewer& viewer, const Words& words)
{
    const size_t dot = words[0].find('.');
    const size_t second = words[0].find('.', dot + 1);
    if (dot == std::string::npos || second == std::string::npos) return false;
    const std::string kind = words[0].substr(0, dot);
    const float number = numberOf(words[0].substr(dot + 1, second - dot - 1));
    const std::string what = words[0].substr(second + 1);
    if (kind != "lamp" && kind != "fixture" && kind != "scanned") return false;
    LightDocument& light = viewer.studio.edit.light;
    std::vector<FixtureItem>& fixtures =
        kind == "scanned" ? viewer.studio.edit.scanned.fixtures : light.fixtures;
    const size_t count = kind == "lamp" ? light.lamps.size() : fixtures.size();
    if (!(number >= 0.0f) || number > 1e9f)
        wrongSetting(
            fmt::format("there is no {}; there are {}", words[0].substr(0, second), count));
    const size_t index = kind == "lamp"
                             ? static_cast<size_t>(number)
                             : viewer.studio.captured().placeOf(static_cast<int>(number));
    if (index >= count)
        wrongSetting(
            fmt::format("there is no {}; there are {}", words[0].substr(0, second), count));
    if (kind == "lamp")
        setLamp(light.lamps[index], what, words);
    else
        setFixture(fixtures[index], what, words);
    return true;
}

} // namespace

void setByScript(Viewer& viewer, const std::vector<std::string>& words)
{
    const auto found = settings().find(words[0]);
    const auto parameter = parameters().find(words[0]);
    if (found != settings().end())
        found->second(viewer, words);
    else if (parameter != parameters().end())
        parameter->second(viewer.studio.edit.parameters, words);
    else if (!setLight(viewer, words))
        wrongSetting(fmt::format("\"{}\" cannot be set", words[0]));
    viewer.studio.commit("Set " + words[0]);
    viewer.studio.settle();
}

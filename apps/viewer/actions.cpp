#include "actions.h"

#include "viewer.h"

#include "relamp/error.h"

#include <array>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include <glm/geometric.hpp>

namespace
{

using relamp::LightType;

template<size_t index>
void showLayer(Viewer& viewer)
{
    viewer.shown.layer = kLayers[index].layer;
}

/// Puts up a light in front of the camera, or above the place that was clicked on.
template<LightType type>
void add(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (studio.scan() == nullptr) return studio.say("Open a scan first.");
    LampItem lamp;
    lamp.type = type;
    lamp.position = viewer.studio.place ? *viewer.studio.place + glm::vec3(0.0f, 0.8f, 0.0f)
                                        : studio.camera.position() + 1.2f * studio.camera.forward();
    if (type == LightType::disc || type == LightType::sphere) lamp.radius = 0.15f;
    if (type == LightType::spot) lamp.radius = 0.03f;
    if (type == LightType::sun) {
        lamp.direction = glm::normalize(glm::vec3(0.4f, -0.8f, 0.3f));
        lamp.unit = "lux";
        lamp.amount = 2000.0f;
        lamp.kelvin = 5500.0f;
    }
    studio.edit.light.lamps.push_back(lamp);
    studio.selection = {Selection::Kind::lamp, studio.edit.light.lamps.size() - 1};
    studio.commit("Add light");
    studio.settle();
    viewer.shown.layer = Layer::relit;
}

void copySelected(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (studio.selection.kind != Selection::Kind::lamp)
        return studio.say("Choose a light of your own to copy it.");
    LampItem lamp = studio.edit.light.lamps[studio.selection.index];
    lamp.position += 0.3f * studio.camera.right();
    studio.edit.light.lamps.push_back(lamp);
    studio.selection.index = studio.edit.light.lamps.size() - 1;
    studio.commit("Copy light");
    studio.settle();
}

void removeSelected(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (studio.selection.kind == Selection::Kind::lamp) {
        auto& lamps = studio.edit.light.lamps;
        lamps.erase(lamps.begin() + static_cast<ptrdiff_t>(studio.selection.index));
        studio.selection = {};
    } else if (studio.selection.kind == Selection::Kind::fixture) {
        studio.edit.light.fixtures[studio.selection.index].on = false;
    }
    studio.commit("Remove light");
    studio.settle();
}

void switchSelected(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    LightDocument& light = studio.edit.light;
    if (studio.selection.kind == Selection::Kind::lamp)
        light.lamps[studio.selection.index].on = !light.lamps[studio.selection.index].on;
    if (studio.selection.kind == Selection::Kind::fixture)
        light.fixtures[studio.selection.index].on = !light.fixtures[studio.selection.index].on;
    studio.commit("Switch light");
    studio.settle();
}

/// Whether the fixture shone on the day of the scan.
void switchScanned(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (studio.selection.kind != Selection::Kind::fixture)
        return studio.say("Choose a lamp of the room to say how it was.");
    bool& on = studio.edit.scanned.fixtures[studio.selection.index].on;
    on = !on;
    studio.commit("Say how it was");
    studio.settle();
}

template<bool on>
void switchFixtures(Viewer& viewer)
{
    for (FixtureItem& fixture : viewer.studio.edit.light.fixtures) fixture.on = on;
    viewer.studio.commit("Switch fixtures");
    viewer.studio.settle();
}

/// All lights in a row: those of the room, then one's own.
template<int step>
void selectNext(Viewer& viewer)
{
    const Studio& studio = viewer.studio;
    const int fixtures = static_cast<int>(studio.edit.light.fixtures.size());
    const int count = fixtures + static_cast<int>(studio.edit.light.lamps.size());
    if (count == 0) return;
    int at = studio.selection.kind == Selection::Kind::none
                 ? (step > 0 ? -1 : 0)
                 : static_cast<int>(studio.selection.index);
    if (studio.selection.kind == Selection::Kind::lamp) at += fixtures;
    at = (at + step + count) % count;
    viewer.select(at < fixtures
                      ? Selection{Selection::Kind::fixture, static_cast<size_t>(at)}
                      : Selection{Selection::Kind::lamp, static_cast<size_t>(at - fixtures)});
}

/// The place that was clicked on, or the fixture that is selected, is a lamp or is none.
template<bool isLight>
void judge(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    relamp::GatherOptions& gather = studio.edit.parameters.gather;
    if (!isLight && studio.selection.kind == Selection::Kind::fixture)
        gather.notLights.push_back(studio.captured().fixtures[studio.selection.index].centre);
    else if (viewer.studio.place)
        (isLight ? gather.lights : gather.notLights).push_back(*viewer.studio.place);
    else
        return studio.say("Click on the place that you mean first.");
    studio.commit(isLight ? "Is a light" : "Is no light");
    studio.settle();
}

/// The place that was clicked on is of one paint with the next that this is said of.
void judgePaint(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (!viewer.studio.place) return studio.say("Click on the place that you mean first.");
    if (!viewer.studio.paint || *viewer.studio.paint == *viewer.studio.place) {
        viewer.studio.paint = viewer.studio.place;
        return studio.say("Click on another place of this paint, and say so again.");
    }
    studio.edit.parameters.gather.same.push_back({*viewer.studio.paint, *viewer.studio.place});
    viewer.studio.paint.reset();
    studio.commit("Is one paint");
    studio.settle();
}

void judgeWhite(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (!viewer.studio.place) return studio.say("Click on the place that you mean first.");
    studio.edit.parameters.gather.white.push_back(*viewer.studio.place);
    studio.commit("Is white");
    studio.settle();
}

void frameSelected(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    studio.isCameraUntouched = false;
    viewer.shown.atlasCentre = glm::vec2(0.5f);
    viewer.shown.atlasZoom = 1.0f;
    const auto light = viewer.selectedLight();
    if (!light) return studio.camera.frame(studio.bounds(), viewer.aspect());
    studio.camera.frame({light->position - 0.5f, light->position + 0.5f}, viewer.aspect());
    studio.camera.comeInside();
}

template<int stops>
void expose(Viewer& viewer)
{
    relamp::ViewOptions& view = viewer.studio.edit.view;
    view.exposure = std::clamp(view.exposure + 0.25f * static_cast<float>(stops), -10.0f, 10.0f);
    viewer.studio.commit("Exposure");
}

void nextView(Viewer& viewer)
{
    relamp::ViewOptions& view = viewer.studio.edit.view;
    view.view = static_cast<relamp::View>((static_cast<int>(view.view) + 1) % 3);
    viewer.studio.commit("Tone mapping");
    viewer.studio.settle();
}

void switchCamera(Viewer& viewer)
{
    CameraRig& camera = viewer.studio.camera;
    camera.mode =
        camera.mode == CameraRig::Mode::orbit ? CameraRig::Mode::walk : CameraRig::Mode::orbit;
}

/// A name beside what is open, that says when.
std::filesystem::path stamped(const Viewer& viewer, const char* ending)
{
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char stamp[32];
    std::strftime(stamp, sizeof(stamp), "%Y%m%d_%H%M%S", &local);
    return fmt::format("{}_{}{}", viewer.studio.path().stem().string(), stamp, ending);
}

void takePicture(Viewer& viewer)
{
    const std::filesystem::path file = std::filesystem::absolute(stamped(viewer, ".png"));
    viewer.screenshot(file, true);
    viewer.studio.say(fmt::format("The picture is {}.", file.string()));
}

void saveLights(Viewer& viewer)
{
    if (viewer.studio.scan() == nullptr) return viewer.studio.say("Open a scan first.");
    viewer.studio.saveLights(
        std::filesystem::absolute(viewer.studio.path().stem().string() + "_lights.json"));
}

void saveBaked(Viewer& viewer)
{
    viewer.studio.saveBaked(
        std::filesystem::absolute(viewer.studio.path().stem().string() + "_relit.glb"));
}

constexpr std::array<Action, 48> kActions{{
    {"layer-texture", "1", "the texture, as scanned", showLayer<0>},
    {"layer-flattened", "2", "its flattened colours", showLayer<1>},
    {"layer-direct", "3", "direct light", showLayer<2>},
    {"layer-indirect", "4", "indirect light", showLayer<3>},
    {"layer-shading", "5", "all light: shading", showLayer<4>},
    {"layer-albedo", "6", "albedo: the room without its light", showLayer<5>},
    {"layer-confidence", "7", "confidence of the albedo", showLayer<6>},
    {"layer-relit", "8", "relit: albedo in the light that you set", showLayer<7>},
    {"compare", "b", "before and after, with a slider",
     [](Viewer& v) { v.shown.compares = !v.shown.compares; }},
    {"wireframe", "x", "the triangles", [](Viewer& v) { v.shown.wireframe = !v.shown.wireframe; }},
    {"atlas", "u", "the atlas: textures laid out flat",
     [](Viewer& v) { v.shown.atlas = !v.shown.atlas; }},
    {"marks", "m", "marks of lights", [](Viewer& v) { v.shown.marks = !v.shown.marks; }},
    {"enter-panels", "f6", "work in the panels by keyboard, or leave them",
     [](Viewer& v) {
         v.shown.inPanels = !v.shown.inPanels;
         v.shown.panels = v.shown.panels || v.shown.inPanels;
     }},
    {"panels", "tab", "panels", [](Viewer& v) { v.shown.panels = !v.shown.panels; }},
    {"help", "f1", "this help", [](Viewer& v) { v.shown.help = !v.shown.help; }},
    {"help-too", "h", "", [](Viewer& v) { v.shown.help = !v.shown.help; }},
    {"frame", "f", "frame what is selected, or the room", frameSelected},
    {"camera", "c", "orbit or walk (W A S D, Q E)", switchCamera},
    {"brighter", "+", "a quarter of a stop brighter", expose<1>},
    {"darker", "-", "a quarter of a stop darker", expose<-1>},
    {"tone", "t", "next tone mapping", nextView},
    {"add-point", "p", "put up a point light", add<LightType::point>},
    {"add-spot", "shift+p", "put up a spot", add<LightType::spot>},
    {"add-rectangle", "r", "put up a panel", add<LightType::rectangle>},
    {"add-disc", "", "put up a disc", add<LightType::disc>},
    {"add-sphere", "shift+r", "put up a globe", add<LightType::sphere>},
    {"add-sun", "", "put up a sun", add<LightType::sun>},
    {"next", "]", "next light", selectNext<1>},
    {"previous", "[", "light before", selectNext<-1>},
    {"switch", "k", "switch the light on or off", switchSelected},
    {"scanned", "shift+k", "it was on or off on the day of the scan", switchScanned},
    {"all-on", "", "switch all fixtures on", switchFixtures<true>},
    {"all-off", "", "switch all fixtures off", switchFixtures<false>},
    {"copy", "ctrl+d", "copy the light", copySelected},
    {"remove", "delete", "remove the light", removeSelected},
    {"is-light", "l", "the place that was clicked on is a lamp", judge<true>},
    {"not-light", "n", "this is no lamp", judge<false>},
    {"one-paint", "o", "this place and the next one are of one paint", judgePaint},
    {"is-white", "i", "this place is white", judgeWhite},
    {"deselect", "escape", "let go",
     [](Viewer& v) {
         if (v.shown.inPanels || v.shown.help) {
             v.shown.inPanels = v.shown.help = false;
             return;
         }
         v.select({});
         v.studio.place.reset();
         v.studio.paint.reset();
     }},
    {"undo", "ctrl+z", "undo", [](Viewer& v) { v.studio.undo(); }},
    {"redo", "ctrl+y", "redo", [](Viewer& v) { v.studio.redo(); }},
    {"redo-too", "ctrl+shift+z", "", [](Viewer& v) { v.studio.redo(); }},
    {"save-lights", "ctrl+s", "save the light as lights.json", saveLights},
    {"save-baked", "ctrl+e", "save a GLB with this light", saveBaked},
    {"picture", "f12", "take a picture", takePicture},
    {"play", "space", "play the timeline, or stop",
     [](Viewer& v) {
         v.studio.play(!v.studio.isPlaying());
         v.shown.layer = Layer::relit;
     }},
    {"quit", "ctrl+q", "quit", [](Viewer& v) { v.quit(); }},
}};

} // namespace

std::span<const Action> actions()
{
    return kActions;
}

bool runActionOf(const KeyChord& chord, Viewer& viewer)
{
    for (const Action& action : kActions)
        if (*action.key != '\0' && chordNamed(action.key) == chord) {
            try {
                action.run(viewer);
            } catch (const relamp::Error& error) {
                viewer.studio.say(error.what());
            }
            return true;
        }
    return false;
}

void runAction(const std::string& name, Viewer& viewer)
{
    for (const Action& action : kActions)
        if (name == action.name) return action.run(viewer);
    throw relamp::Error(relamp::ErrorCode::malformed,
                        fmt::format("\"{}\" is nothing that the viewer does", name));
}

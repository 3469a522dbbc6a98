#include "studio.h"

#include "room_page.h"
#include "text_file.h"

#include "relamp/error.h"
#include "relamp/page.h"
#include "relamp/result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace
{

/// What a JSON file says that it is: "relamp lights 1", "relamp timeline 1", or nothing.
std::string formatOf(const std::filesystem::path& file)
{
    const nlohmann::json json = nlohmann::json::parse(textFrom(file), nullptr, false);
    return json.is_object() && json.contains("format") && json["format"].is_string()
               ? json["format"].get<std::string>()
               : "";
}

} // namespace

void Studio::openAny(const std::filesystem::path& path)
{
    try {
        if (path.extension() != ".json") return open(path, {});
        formatOf(path).starts_with("relamp timeline") ? loadTimeline(path) : loadLights(path);
    } catch (const relamp::Error& error) {
        say(error.what());
    }
}

void Studio::saveLights(const std::filesystem::path& file)
{
    writeText(file, textOf(edit.light, room_.captured));
    say(fmt::format("The light is in {}.", file.string()));
}

void Studio::loadLights(const std::filesystem::path& file)
{
    std::vector<std::string> notes;
    edit.light = documentFrom(textFrom(file), file, room_.captured, notes);
    room_.lightsFolder = file.parent_path();
    room_.reader = {}; // what it names may be another by now
    commit("Load lights");
    settle();
    for (const std::string& note : notes) say(note);
    say(fmt::format("This is the light of {}.", file.string()));
}

void Studio::saveResult(const std::filesystem::path& folder)
{
    if (!room_.decomposition) return say("The room is not solved yet; it can be saved when it is.");
    saver_.start(
        [this, folder, found = room_.decomposition, path = room_.path](relamp::Progress& progress) {
            relamp::writeResult(*found, path, folder, progress);
            mailbox_.post([this, folder] {
                say(fmt::format("The room without its light is in {}.", folder.string()));
            });
        });
}

void Studio::saveBaked(const std::filesystem::path& file)
{
    if (!drawing_.has(Layer::relit))
        return say("The room is not lit anew yet; it can be saved when it is.");
    light_.bake(file, edit.view, [this, file] {
        say(fmt::format("The room with this light is in {}.", file.string()));
    });
}

/// What is off here can be switched on there.
relamp::Relighting Studio::lightOfPage(std::vector<std::string>& notes)
{
    relamp::Relighting light =
        lightingOf(edit.light, room_.lightsFolder, room_.captured, notes, room_.reader);
    const relamp::Relighting found = relamp::asCaptured(room_.captured);
    for (size_t i = 0; i < found.fixtures.size(); ++i)
        if (light.fixtures[i].fixture.radiance == glm::vec3(0.0f))
            light.fixtures[i].fixture = found.fixtures[i].fixture;
    if (light.sky.radiance == glm::vec3(0.0f)) light.sky = found.sky;
    return light;
}

void Studio::savePage(const std::filesystem::path& folder)
{
    if (stage() != Stage::solved)
        return say("The room is not solved yet; its page can be written when it is.");
    const relamp::PageOptions page{.viewer = pageViewer()};
    relamp::checkPage(folder, page);
    relamp::checkPage(*room_.scan);
    std::vector<std::string> notes;
    const relamp::Relighting light = lightOfPage(notes);
    for (const std::string& note : notes) say(note);
    saver_.start([this, folder, page, light, found = room_.decomposition,
                  path = room_.path](relamp::Progress& progress) {
        const relamp::DelitRoom room = found ? relamp::delitRoomOf(*found, progress)
                                             : relamp::readDelitRoom(path, {}, progress);
        relamp::Relighter relighter(room, {.engine = engine_}, progress);
        const relamp::WrittenPage written =
            relamp::writePage(relighter, light, folder, page, progress);
        mailbox_.post([this, folder, lacks = written.notes] {
            for (const std::string& note : lacks) say(note);
            say(fmt::format("The page is {}.", (folder / "index.html").string()));
        });
    });
}

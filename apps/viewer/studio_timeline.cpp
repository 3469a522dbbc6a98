#include "studio.h"

#include <cmath>
#include <utility>

void Studio::loadTimeline(const std::filesystem::path& file)
{
    std::vector<std::string> notes;
    room_.timeline.emplace(file, room_.captured, notes);
    for (const std::string& note : notes) say(note);
    room_.part = 0.0;
    play(true);
}

void Studio::play(bool on)
{
    if (on && !room_.timeline) return say("There is no timeline; drop one into the window.");
    const bool stops = room_.isPlaying && !on;
    room_.isPlaying = on;
    if (stops) sendLight();
}

void Studio::passTime(double seconds)
{
    if (!room_.isPlaying) return;
    seek(std::fmod(room_.part + seconds / room_.timeline->seconds(), 1.0));
}

void Studio::seek(double part)
{
    if (!room_.timeline) return;
    room_.part = part;
    room_.isPlaying = room_.isPlaying || part > 0.0;
    relamp::Relighting lighting = room_.timeline->at(part);
    if (drawing_.has(Layer::relit)) light_.shine(std::move(lighting));
}

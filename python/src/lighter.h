#pragma once

#include "relamp/delight.h"
#include "relamp/picture.h"
#include "relamp/relight.h"

#include <mutex>
#include <string>
#include <vector>

/// A room and what rays found of it, for one light after the other.
class Lighter
{
public:
    Lighter(const relamp::Decomposition& decomposition, relamp::Progress& progress)
        : room(relamp::delitRoomOf(decomposition, progress)), relighter_(room, {}, progress),
          photographer(relighter_)
    {}

    /// Lends the relighter under `light` to `use`, and to nobody else meanwhile. `warnings`
    /// receives what is doubtful of the light.
    template<class Use>
    auto under(const relamp::Relighting& light, std::vector<std::string>& warnings,
               relamp::Progress& progress, const Use& use)
    {
        const std::scoped_lock one(mutex_);
        relighter_.light(light, progress);
        warnings.insert(warnings.end(), relighter_.warnings().begin(), relighter_.warnings().end());
        return use(relighter_);
    }

    const relamp::DelitRoom room;

private:
    std::mutex mutex_;
    relamp::Relighter relighter_;

public:
    const relamp::Photographer photographer;
};

/// The light that `text` tells of, a lights file's that lies at `file`, and `settings` of the
/// room's own lamps; empty: all is dark but for what `settings` turn on.
inline relamp::Relighting lightOf(const relamp::Lights& captured, const std::string& text,
                                  const std::filesystem::path& file,
                                  const std::vector<std::string>& settings,
                                  std::vector<std::string>& warnings)
{
    relamp::Relighting light =
        text.empty() ? relamp::darkened(captured)
                     : relamp::RelightingReader().read(text, file, captured, warnings);
    for (const std::string& setting : settings) relamp::setFixture(light, captured, setting);
    return light;
}

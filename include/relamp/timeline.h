#pragma once

#include "relamp/api.h"
#include "relamp/lights.h"
#include "relamp/relight.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relamp
{

/// What a file calls a moment.
struct TimelineKey
{
    double time = 0.0; // in the file's unit, ascending
    double part = 0.0; // of the film, 0..1
    std::string name;  // may be empty
};

/// Light that changes: lights files as keys in time, and what is between them.
class RELAMP_API Timeline
{
public:
    /// Reads a timeline, described in docs/guide/relighting.md. `warnings` receives a sentence a
    /// key that was passed over. Throws Error(cannotRead | malformed) naming the file, the line and
    /// the key, also where two keys that follow each other do not fit together.
    Timeline(const std::filesystem::path& file, const Lights& captured,
             std::vector<std::string>& warnings);
    ~Timeline();
    Timeline(Timeline&&) noexcept;
    Timeline& operator=(Timeline&&) noexcept;

    /// How long the film is, > 0.
    [[nodiscard]] double seconds() const;

    [[nodiscard]] const std::filesystem::path& file() const;

    /// The moments that the file says, two or more.
    [[nodiscard]] std::vector<TimelineKey> keys() const;

    /// The light at a part of the film, 0..1. Between two keys numbers change evenly, so light adds
    /// up as light does; colour temperatures evenly in mired, which is how people see them; what is
    /// no number stays until the next key.
    [[nodiscard]] Relighting at(double part) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace relamp

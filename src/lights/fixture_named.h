#pragma once

#include "lights/json_item.h"
#include "relamp/lights.h"

#include <string>
#include <string_view>

namespace relamp
{

/// The number of a fixture that an item of a file has under `key`, which must be there. Refuses
/// what is no number, 0..kLargestFixtureId.
int fixtureIdAt(const JsonItem& item, const char* key);

/// The place of the fixture that a person means by its number or its name, whatever its letters'
/// case; fixtures.size() where there is none.
size_t placeOfNamed(const Lights& lights, std::string_view numberOrName);

/// All names, as a sentence lists them: "window 0, ceiling lamp 1"; "none".
std::string namesOf(const Lights& lights);

} // namespace relamp

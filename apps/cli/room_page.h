#pragma once

#include <filesystem>

/// Where what a page runs in the browser lies: as installed, or where a build folder has it. Throws
/// relamp::Error with a sentence where it is not there.
std::filesystem::path pageViewer();

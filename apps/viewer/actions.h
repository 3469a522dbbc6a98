#pragma once

#include "input.h"

#include <span>
#include <string>
#include <vector>

class Viewer;

/// Something that a key, a button or a script has the viewer do.
struct Action
{
    const char* name; // in scripts
    const char* key;  // as in "ctrl+z"; "" for none
    const char* says; // in the help
    void (*run)(Viewer&);
};

std::span<const Action> actions();

/// Runs what the key stands for; false where it stands for nothing.
bool runActionOf(const KeyChord& chord, Viewer& viewer);

/// Throws relamp::Error where there is no such action.
void runAction(const std::string& name, Viewer& viewer);

#pragma once

#include "relamp/error.h"

#include <string>

namespace relamp::scenes
{

/// What an Error of `action` says; empty where there is none.
template<class Action>
std::string refusalOf(const Action& action)
{
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace relamp::scenes

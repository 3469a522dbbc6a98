#pragma once

#include <string>
#include <vector>

class Viewer;

/// `set NAME VALUE ...` of a script. Throws relamp::Error with a sentence that says what there is.
void setByScript(Viewer& viewer, const std::vector<std::string>& words);

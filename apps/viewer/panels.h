#pragma once

class Viewer;

/// Describes all panels: what is open, layers, lights, solver, status and help.
void drawPanels(Viewer& viewer);

/// Parts of the side panel, each under its own heading.
void drawLightPanel(Viewer& viewer);
void drawSkyPanel(Viewer& viewer);
void drawFoundPanel(Viewer& viewer);
void drawSolverPanel(Viewer& viewer);
void drawFilePanel(Viewer& viewer);
void drawHelp();

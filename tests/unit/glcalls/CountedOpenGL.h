#pragma once

/// Return how often functions of OpenGL were called in this process.
extern "C" unsigned long gnomonCountOfGlCalls();

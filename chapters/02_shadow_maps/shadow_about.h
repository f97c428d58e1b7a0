// shadow_about: the chapter's tables: parameters, steps, rows of the sweep and cases of the stability table.
#ifndef SHADOW_ABOUT_H
#define SHADOW_ABOUT_H

#include "run.h"

extern const RunAbout shadow_about;

#endif

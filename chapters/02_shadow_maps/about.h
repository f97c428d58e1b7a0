// about: the chapter's tables: parameters, steps, rows of the sweep and cases of the stability table.
#ifndef ABOUT_H
#define ABOUT_H

#include "run.h"

extern const RunAbout about;

#endif

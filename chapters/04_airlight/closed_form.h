// closed_form: the airlight of a whole ray in one evaluation, without shadow: by Sun et al.'s table, Pegoraro's series, Gauss's rule.
#ifndef CLOSED_FORM_H
#define CLOSED_FORM_H

#include "airlight.h"

// Whether `method` is one of sun, pegoraro, gauss: they know no shadow.
bool closed_form_is(const char *method);
// `settings` with the shader of its method, if that is a closed form; else with common/airlight's own. `table` is closed_form_table's; only sun reads it.
AirlightSettings closed_form_settings(AirlightSettings settings, GLuint table);
GLuint closed_form_table(int size); // F as a texture, size² texels; the caller deletes it

// Sun et al.'s F(u, v) by GSL: size² values, u fastest, u in [0, SUN_MOST_U], v in [0, π/2]; new memory.
#define SUN_MOST_U 10.0 // as in shaders/04_airlight/sun.glsl
float *sun_table(int size);
double sun_f(double u, double v);

#endif

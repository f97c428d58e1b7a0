// turn: turn space about its diagonal so that the axis to look along (0 x, 1 y, 2 z) comes last, and back. A turn keeps right-handedness.
#ifndef TURN_GLSL
#define TURN_GLSL
#define TURN(v, axis) ((axis) == 0 ? (v).yzx : (axis) == 1 ? (v).zxy : (v).xyz)
#define TURN_BACK(v, axis) ((axis) == 0 ? (v).zxy : (axis) == 1 ? (v).yzx : (v).xyz)
#endif

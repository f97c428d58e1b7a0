// attribute_steps: an albedo and a normal's component as integers, as attributes.c reads them back. 10 bits are finer than any display, and
// 2^32 / 1023 = 4.2 million fragments fit a sum.
const float ALBEDO_STEPS = 1023.0, NORMAL_STEPS = 511.0;

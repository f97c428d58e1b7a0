#ifdef SOLUTION
#define TWICE 2.0f
#else
#define TWICE 3.0f
#endif

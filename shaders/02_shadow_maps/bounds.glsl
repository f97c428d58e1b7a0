// bounds: what of one layer of a depth map the picture asks for, in tiles, so that a small motion asks for the same. All zero: nothing.
const int TILES = 16; // along a side of a layer

struct Bounds {
    uint pixels;                 // that lie in this layer
    uint from_end_x, from_end_y; // TILES - first tile
    uint end_x, end_y;           // tile after the last; 0: the layer is not asked
    uint farthest;               // metres, a float's bits
};

uniform int map_size; // texels a side

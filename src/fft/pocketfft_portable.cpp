// Transforms with the instructions that all processors of a kind have
#define LANES portable
#include "pocketfft_transforms.hpp"

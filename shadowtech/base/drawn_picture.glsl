// The sampler of the images that a picture was drawn into (DrawnPicture in PictureMean.h).

#if SAMPLES > 1
#define PICTURE_SAMPLER sampler2DMS
#else
#define PICTURE_SAMPLER sampler2D
#endif

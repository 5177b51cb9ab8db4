// The light of a sky, by the view that each pixel's receiver has of it (shadowtech/sky/).

uniform vec3 gnomonSkyLight; // colour times intensity
float gnomonSkyView = 1.0;   // of translucent surfaces, and of those that show no shadows

// The pass's additions to VTK's shaders of volumes, after hook.glsl and the lights' techniques.

mat4 gnomonViewFromData; // of places that VTK samples (g_dataPos)

// Find the matrix once for all samples of a fragment: once for each costs half a frame more.
void gnomonPlaceSamples()
{
  // VTK's texture coordinates of points and cells differ by a scale and an offset.
  mat4 cellToPoint = in_cellToPoint[0];
  vec3 scale = 1.0 / vec3(cellToPoint[0].x, cellToPoint[1].y, cellToPoint[2].z);
  mat4 textureFromData = mat4(1.0);
  textureFromData[0].x = scale.x;
  textureFromData[1].y = scale.y;
  textureFromData[2].z = scale.z;
  textureFromData[3].xyz = -cellToPoint[3].xyz * scale;
  gnomonViewFromData =
    in_modelViewMatrix * in_volumeMatrix[0] * in_textureDatasetMatrix[0] * textureFromData;
#if !VTK_VIEW_IS_RIGID
  gnomonViewFromData = gnomonViewFromVtkView * gnomonViewFromData;
#endif
}

// The pass's additions to VTK's shaders of volumes, after hook.glsl and the lights' techniques.

// Return the place of the sample that VTK lights.
vec3 gnomonSampleInView()
{
  // VTK's texture coordinates of points and cells differ by a scale and an offset.
  mat4 cellToPoint = in_cellToPoint[0];
  vec3 placeTexture = (g_dataPos - cellToPoint[3].xyz) /
    vec3(cellToPoint[0].x, cellToPoint[1].y, cellToPoint[2].z);
  vec4 place = in_modelViewMatrix *
    (in_volumeMatrix[0] * (in_textureDatasetMatrix[0] * vec4(placeTexture, 1.0)));
  return gnomonInView(place.xyz / place.w);
}

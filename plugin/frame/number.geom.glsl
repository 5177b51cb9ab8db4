//VTK::System::Dec
// Hands primitives on unchanged, with the number that the driver counts for geometry shaders.
//GNOMON::Extensions

//GNOMON::Layout

//GNOMON::Varyings::Dec
flat out int gnomonPrimitiveGSOutput;

void main()
{
  for (int i = 0; i < gl_in.length(); ++i)
  {
    gl_Position = gl_in[i].gl_Position;
    gl_PrimitiveID = gl_PrimitiveIDIn;
    gnomonPrimitiveGSOutput = gl_PrimitiveIDIn;
    //GNOMON::Varyings::Impl
    EmitVertex();
  }
  EndPrimitive();
}

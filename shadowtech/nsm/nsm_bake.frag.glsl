// bake

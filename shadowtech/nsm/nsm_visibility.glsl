// vis

"""Judges that are not the compiler: libsdformat, urdfdom, and a comparison of XML trees."""

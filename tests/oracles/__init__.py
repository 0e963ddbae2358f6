"""Judges that are not the compiler: urdfdom, and a comparison of XML trees; the engines are in the testing kit."""

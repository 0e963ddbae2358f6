"""What converters make of URDF in USD, and losses that are planted in it."""

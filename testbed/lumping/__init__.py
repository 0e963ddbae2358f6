"""What libsdformat makes of fixed joints, beside what we make of them."""

"""Is a world the same once it was taken apart and put together again?"""

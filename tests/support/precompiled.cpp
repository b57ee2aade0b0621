// The owner of the precompiled headers; it has nothing to say of its own.

// Belongs to none.

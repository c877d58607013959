const char* const version = "4.5.6";

// Comments may say beside, and strings too.
const char* kAccepted = "beside";
int kBesideOthers = 1;
int besides = 2;
int GrowingUtterance = 3;
int Weaver = 4;
int Weavers = 5;

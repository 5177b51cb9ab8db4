// How a pixel's visibility was found: the classes of MonteCarlo::info(), in their order.

#define NO_RECEIVER 0.0
#define TURNED_AWAY 1.0
#define LIT 2.0
#define UMBRA 3.0
#define BY_RAYS 4.0
#define SEARCHED 5.0

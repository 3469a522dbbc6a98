#include <relamp/scan.h>

#include <iostream>

int main(int, char** argv)
{
    relamp::Progress progress;
    std::cout << relamp::readScan(argv[1], {}, progress).triangleCount() << '\n';
}

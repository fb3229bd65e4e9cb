; push the plug in, twice if need be
        TRANS   T [20 28 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        VECT    DOWN [0 0 -50]
        MOVE    T
        STOP    DOWN
        CHANGE  DOWN .5
        SKIPN   23
        MOVE    DOWN            ;a little further
        CHANGE  Z 1
        PARK

; feel for the top of the base
        TRANS   T [20 28 8 90 90 0]
        VECT    DOWN 0 0 -50]
        MOVE    T
        STOP    DOWN
        CHANGE  DOWN .8
        SKIPN   23
        WAIT    "nothing met"
        CHANGE  Z 1

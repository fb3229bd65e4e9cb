; carry the pump base to the middle of the table
        TRANS   BELT [18 44 3 90 90 0]
        TRANS   MIDDLE [25 38 4 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        OPEN    3
        MOVE    BELT
        CLOSE   1.5 2.5
        LOAD    900             ;it weighs 900 g
        CHANGE  Z 2
        MOVE    MIDDLE
        PLACE
        LOAD    0
        OPEN    3
        PARK

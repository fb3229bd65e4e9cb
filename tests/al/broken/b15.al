; put the pin away
        TRANS   P [18 44 3 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        OPEN    1               ;wide enough for the head
        MOVE    P               ;go to the pin
        CLOSE   .1              ;at least a tenth must be there
        MOVE    T               ;over the box
        OPEN    .5              :let it drop
        CHANGE  Z 1             ;and get away
